//! The paper's three scenarios from its two starts, as the command `closeranks paper` has them.

/// Start, attack and text.
const SCENARIOS: [(&str, &str, &str); 6] = [
    ("inside", "nominal", include_str!("../../../scenarios/inside-nominal.toml")),
    ("inside", "understating", include_str!("../../../scenarios/inside-understating.toml")),
    ("inside", "overstating", include_str!("../../../scenarios/inside-overstating.toml")),
    ("published", "nominal", include_str!("../../../scenarios/published-nominal.toml")),
    ("published", "understating", include_str!("../../../scenarios/published-understating.toml")),
    ("published", "overstating", include_str!("../../../scenarios/published-overstating.toml")),
];

/// The text of one, or what is allowed.
pub(crate) fn text(attack: &str, start: &str) -> Result<&'static str, String> {
    let found = SCENARIOS.iter().find(|(a_start, an_attack, _)| *a_start == start && *an_attack == attack);
    found.map(|(_, _, text)| *text).ok_or_else(|| {
        format!(
            "the paper has no scenario \"{attack}\" from the start \"{start}\", allowed are \"nominal\", \
             \"understating\" and \"overstating\" from \"inside\" and \"published\""
        )
    })
}
