//! How wide a text is, without reading the font.

/// Advances of DejaVu Sans for the characters from space to tilde, in 1/2048 of the font size.
const ADVANCES: [u16; 95] = [
    651, 821, 942, 1716, 1303, 1946, 1597, 563, 799, 799, 1024, 1716, 651, 739, 651, 690, 1303, 1303, 1303,
    1303, 1303, 1303, 1303, 1303, 1303, 1303, 690, 690, 1716, 1716, 1716, 1087, 2048, 1401, 1405, 1430, 1577,
    1294, 1178, 1587, 1540, 604, 604, 1343, 1141, 1767, 1532, 1612, 1235, 1612, 1423, 1300, 1251, 1499, 1401,
    2025, 1403, 1251, 1403, 799, 690, 799, 1716, 1024, 1024, 1255, 1300, 1126, 1300, 1260, 721, 1300, 1298,
    569, 569, 1186, 569, 1995, 1298, 1253, 1300, 1300, 842, 1067, 803, 1298, 1212, 1675, 1212, 1212, 1075,
    1303, 690, 1303, 1716,
];

/// Advance of a character outside the table: that of the minus sign, and two thirds more than a letter's.
const OTHER: u16 = 1716;

/// Width of `text` at font size `size`, in the unit of the size; kerning is left out, so it is a little too wide.
#[must_use]
pub(crate) fn width(text: &str, size: f64) -> f64 {
    text.chars().map(|character| f64::from(advance(character))).sum::<f64>() * size / 2048.0
}

fn advance(character: char) -> u16 {
    let place = (character as usize).checked_sub(0x20);
    place.and_then(|place| ADVANCES.get(place)).copied().unwrap_or(OTHER)
}

/// `text`, cut with an ellipsis if it is wider than `room`.
#[must_use]
pub(crate) fn shorten(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.into();
    }
    let mut short = String::new();
    for character in text.chars() {
        short.push(character);
        if width(&short, size) + width("…", size) > room {
            short.pop();
            break;
        }
    }
    short.trim_end().to_owned() + "…"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_cut_only_if_they_must() {
        assert_eq!(shorten("nominal", 12.0, 80.0), "nominal");
        let short = shorten("a very long name of a scenario", 12.0, 80.0);
        assert!(short.ends_with('…') && width(&short, 12.0) <= 80.0, "{short}");
        assert_eq!(shorten("name", 12.0, 0.0), "…");
    }
}
