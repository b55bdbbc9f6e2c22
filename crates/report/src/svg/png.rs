//! SVG to PNG, with the fonts that this crate brings along.

use core::error::Error;
use std::sync::{Arc, OnceLock};

use ::png::{BitDepth, ColorType, Compression, Encoder, EncodingError};
use dejavu::sans;
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{self, Options, Tree, fontdb};

/// Scale at which figures have 200 dots an inch.
pub const SCALE_200_DPI: f32 = 200.0 / 96.0;

/// Longest side of a picture, dots.
const LONGEST: f32 = 20_000.0;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PngError {
    /// The document cannot be read.
    #[error("the figure is not valid SVG")]
    Svg(#[from] usvg::Error),
    /// The picture would be empty or too large.
    #[error("a picture of {width} by {height} dots cannot be made; allowed is 1 to 20000 a side")]
    Size {
        /// Dots from left to right.
        width: f32,
        /// Dots from top to bottom.
        height: f32,
    },
    /// The picture cannot be written.
    #[error("the picture cannot be written as PNG")]
    Encode(#[source] Box<dyn Error + Send + Sync>),
}

/// The picture of an SVG document at `scale` dots per unit; [`SCALE_200_DPI`] is good for print.
///
/// Only DejaVu Sans is known, no font of the system: the same document gives the same bytes everywhere.
pub fn png(svg: &str, scale: f32) -> Result<Vec<u8>, PngError> {
    let tree = Tree::from_str(svg, &options())?;
    let mut pixmap = canvas(tree.size().width() * scale, tree.size().height() * scale)?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    encode(&pixmap).map_err(|error| PngError::Encode(Box::new(error)))
}

/// On white, without transparency, at the cheapest level: a figure is mostly one colour and stays small, and of the
/// instructions of `closeranks paper` three in four were spent on compressing it harder.
fn encode(pixmap: &Pixmap) -> Result<Vec<u8>, EncodingError> {
    let colours = pixmap.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]);
    let colours: Vec<u8> = colours.collect();
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, pixmap.width(), pixmap.height());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.write_header()?.write_image_data(&colours)?;
    Ok(file)
}

fn canvas(width: f32, height: f32) -> Result<Pixmap, PngError> {
    let error = PngError::Size { width, height };
    if !(1.0..=LONGEST).contains(&width) || !(1.0..=LONGEST).contains(&height) {
        return Err(error);
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 20000")]
    let [width, height] = [width, height].map(|side| side.round() as u32);
    let mut pixmap = Pixmap::new(width, height).ok_or(error)?;
    pixmap.fill(Color::WHITE);
    Ok(pixmap)
}

fn options() -> Options<'static> {
    // Read once for all figures.
    static FONTS: OnceLock<Arc<fontdb::Database>> = OnceLock::new();
    let fonts = FONTS.get_or_init(|| {
        let mut fonts = fontdb::Database::new();
        for font in [sans::regular(), sans::bold(), sans::oblique()] {
            fonts.load_font_source(fontdb::Source::Binary(Arc::new(font)));
        }
        Arc::new(fonts)
    });
    Options { fontdb: fonts.clone(), font_family: "DejaVu Sans".into(), ..Options::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::svg::text::width;

    const SMALL: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"30\" height=\"20\" \
        font-family=\"DejaVu Sans\" font-size=\"16\"><text x=\"2\" y=\"16\">(b) overstating, WAVE</text></svg>";

    #[test]
    fn pictures_have_the_size_asked_for() {
        let picture = png(SMALL, 2.0).unwrap();
        assert_eq!(&picture[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(picture[16..24], [0, 0, 0, 60, 0, 0, 0, 40]);
        assert_eq!(picture, png(SMALL, 2.0).unwrap());
    }

    #[test]
    fn what_cannot_be_drawn_is_an_error() {
        assert!(matches!(png("<svg", 1.0), Err(PngError::Svg(_))));
        for scale in [0.0, -1.0, f32::NAN, 1e9] {
            assert!(matches!(png(SMALL, scale), Err(PngError::Size { .. })));
        }
    }

    #[test]
    fn the_table_of_widths_is_that_of_the_font() {
        let tree = Tree::from_str(SMALL, &options()).unwrap();
        let drawn = f64::from(tree.root().abs_bounding_box().width());
        let table = width("(b) overstating, WAVE", 16.0);
        assert!((drawn - table).abs() < 0.03 * table, "{drawn} {table}");
    }
}
