//! The pictures of a report on one pair.

use crate::failure::Failure;
use crate::input::Input;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use nurbs_hausdorff_pictures::{Clash, Figure, Picture, PictureOptions, Pictures, clash_pictures, pictures};
use quick_xml::escape::escape;
use std::fmt::Write as _;
use std::io::Write as _;

/// Draws two models; the addresses of the pictures contain them.
///
/// # Errors
/// Those of [`pictures`].
pub(crate) fn figures(a: &Input, b: &Input, options: &PictureOptions) -> Result<String, Failure> {
    let Pictures { figures, legend, .. } = pictures(&a.prepared, &b.prepared, options, compressed)?;
    Ok(html(&figures, &legend))
}

/// Draws two bodies that clash, as [`figures`] does.
///
/// # Errors
/// Those of [`clash_pictures`].
pub(crate) fn clash_figures(clash: &Clash<'_>) -> Result<String, Failure> {
    Ok(html(&clash_pictures(clash, compressed)?, ""))
}

fn html(figures: &[Figure], legend: &str) -> String {
    let mut text = String::new();
    for Figure { caption, pictures, .. } in figures {
        text.push_str("<figure class=\"views\">\n<div>\n");
        for Picture { alt, size: [width, height], png, .. } in pictures {
            // Writing to a string does not fail.
            let _ = writeln!(
                text,
                "<img width=\"{width}\" height=\"{height}\" alt=\"{}\" src=\"data:image/png;base64,{}\">",
                escape(alt.as_str()),
                STANDARD.encode(png)
            );
        }
        let _ = writeln!(text, "{legend}\n</div>\n<figcaption>{}</figcaption>\n</figure>", escape(caption));
    }
    text
}

fn compressed(bytes: &[u8]) -> Result<Vec<u8>, Failure> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).and_then(|()| encoder.finish()).map_err(Failure::Output)
}
