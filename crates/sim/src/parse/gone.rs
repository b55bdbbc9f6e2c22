//! Fields that scenario texts once had, and what took their place.

/// Full names, and what to write instead.
const GONE: [(&str, &str); 4] = [
    (
        "controller.trust",
        "no such choice: `budget` believes only what it senses, as with `trust = \"seen\"` before; for robots that tell each \
         other of their motion there is `controller.kind = \"links\"`",
    ),
    (
        "controller.rise",
        "`controller.gamma`: a larger one lets robots spread faster, and does it better than `rise` did",
    ),
    ("clock.drift_s", "nothing: no told level has an age any more, and missing robots are reckoned in ticks"),
    (
        "clocks.slow",
        "`clocks.drift_max`, by which each clock may be slow or fast; no guarantee rests on clocks any more",
    ),
];

/// What took the place of `field`, by its full name; `None` if there never was such a field.
pub(super) fn instead(field: &str) -> Option<&'static str> {
    GONE.iter().find(|(gone, _)| *gone == field).map(|(_, instead)| *instead)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse::scenario;

    /// A text with nothing but this field, whose full name is `SECTION.NAME`.
    fn text(field: &str, value: &str) -> String {
        let (section, name) = field.split_once('.').unwrap();
        format!("[{section}]\n{name} = {value}\n")
    }

    #[test]
    fn every_field_that_is_gone_is_refused_with_what_took_its_place() {
        for (field, instead) in GONE {
            for value in ["0.1", "\"seen\"", "[]"] {
                let text = text(field, value);
                let problems = scenario(&text).unwrap_err();
                let said: Vec<String> = problems.iter().map(ToString::to_string).collect();
                assert_eq!(said, [format!("`{field}` is no longer a field, allowed is {instead}")]);
                let (_, name) = field.split_once('.').unwrap();
                assert_eq!(&text[problems[0].span.clone()], name);
            }
        }
        let problems = scenario("[controller]\ntrusts = 1\n").unwrap_err();
        assert_eq!(problems[0].found, "not a field here", "what never was one has no other name");
    }

    #[test]
    fn what_took_its_place_is_there() {
        for text in [
            "[controller]\nkind = \"links\"\n".to_owned(),
            text("controller.gamma", "0.5"),
            text("clocks.drift_max", "0.1"),
        ] {
            assert_eq!(scenario(&text).err(), None, "{text}");
        }
        let named = |name: &str| GONE.iter().any(|(_, instead)| instead.contains(&format!("`{name}")));
        assert!(
            ["controller.kind = \"links\"`", "controller.gamma`", "clocks.drift_max`"].into_iter().all(named)
        );
    }
}
