//! What a value of the text is, and how a message shows it.

use toml::de::DeValue;

/// A number written as integer or float.
pub(crate) fn number(value: &DeValue<'_>) -> Option<f64> {
    let number = match value {
        #[expect(clippy::cast_precision_loss, reason = "a whole number above 2^53 is out of every range")]
        DeValue::Integer(_) => whole_signed(value)? as f64,
        DeValue::Float(float) => float.as_str().parse().ok()?,
        _ => return None,
    };
    number.is_finite().then_some(number)
}

/// A whole number, not negative.
pub(crate) fn whole(value: &DeValue<'_>) -> Option<u64> {
    whole_signed(value).and_then(|whole| u64::try_from(whole).ok())
}

/// A whole number.
pub(crate) fn whole_signed(value: &DeValue<'_>) -> Option<i64> {
    let integer = value.as_integer()?;
    i64::from_str_radix(integer.as_str(), integer.radix()).ok()
}

/// Names as a message lists them.
pub(crate) fn one_of<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// The value, shortened, as an error shows it.
pub(crate) fn describe(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("\"{}\"", printable(text)),
        DeValue::Integer(integer) => printable(&integer.to_string()),
        DeValue::Float(float) => printable(float.as_str()),
        DeValue::Boolean(flag) => flag.to_string(),
        DeValue::Datetime(_) => "a date".to_owned(),
        DeValue::Array(items) => format!("a list of {}", items.len()),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// The text, shortened and without control characters.
pub(crate) fn printable(text: &str) -> String {
    let short: String = text.chars().take(40).flat_map(char::escape_debug).collect();
    if text.chars().count() > 40 { format!("{short}...") } else { short }
}
