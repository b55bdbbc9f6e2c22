//! Fields that scenario texts once had, and what took their place.

/// What took the place of `field`, by its full name; `None` if there never was such a field.
pub(super) fn instead(field: &str) -> Option<&'static str> {
    Some(match field {
        "controller.trust" => {
            "no such choice: `budget` believes only what it senses, as with `trust = \"seen\"` before; for robots that tell each \
             other of their motion there is `controller.kind = \"links\"`"
        }
        "controller.rise" => {
            "`controller.gamma`: a larger one lets robots spread faster, and does it better than `rise` did"
        }
        "clock.drift_s" => {
            "nothing: no told level has an age any more, and missing robots are reckoned in ticks"
        }
        "clocks.slow" => {
            "`clocks.drift_max`, by which each clock may be slow or fast; no guarantee rests on clocks any more"
        }
        _ => return None,
    })
}
