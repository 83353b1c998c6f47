//! Labels from the flat colours of a picture.

use super::error::{MapError, MapProblem};
use super::raster::Canvas;
use crate::labels::Labels;
use std::io::Cursor;

/// The largest width or height of a picture, in pixels.
pub const MAX_SIDE: usize = 4096;
/// A picture without legend has fewer colours than this.
const FLAT: usize = 64;

/// A decoded picture: red, green, blue and opacity of each pixel, row by row from the top.
#[derive(Clone, PartialEq, Debug)]
pub struct Picture {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// width · height pixels.
    pub pixels: Vec<[u8; 4]>,
}

/// Which label a colour stands for; `None` is free ground.
pub(super) struct Legend {
    pub colours: Vec<([u8; 3], Option<usize>)>,
    /// How far each channel may be off.
    pub tolerance: u8,
    /// Whether colours outside the legend are free ground rather than an error.
    pub others_free: bool,
}

/// The labels, and the label of each colour; `None` is free ground.
pub(super) type Guess = (Vec<String>, Vec<([u8; 3], Option<String>)>);

impl Picture {
    /// Reads a PNG file of any colour type.
    ///
    /// # Errors
    /// Bytes that are no PNG, or a side of more than [`MAX_SIDE`] pixels.
    pub fn from_png(bytes: &[u8]) -> Result<Picture, MapError> {
        let broken = |error: png::DecodingError| MapError::new("picture", MapProblem::Png(error.to_string()));
        let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: 256 << 20 });
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().map_err(broken)?;
        let (width, height) = (reader.info().width as usize, reader.info().height as usize);
        let longer = width.max(height);
        if longer > MAX_SIDE {
            let problem = MapProblem::TooMany { what: "pixels on a side", found: longer, limit: MAX_SIDE };
            return Err(MapError::new("picture", problem));
        }
        let size = reader.output_buffer_size().expect("at most 4096² pixels of 4 bytes fit the memory");
        let mut buffer = vec![0; size];
        let frame = reader.next_frame(&mut buffer).map_err(broken)?;
        let channels = frame.color_type.samples();
        let pixel = |p: &[u8]| match *p {
            [grey] => [grey, grey, grey, 255],
            [grey, opacity] => [grey, grey, grey, opacity],
            [r, g, b] => [r, g, b, 255],
            _ => [p[0], p[1], p[2], p[3]],
        };
        let pixels: Vec<[u8; 4]> = buffer.chunks_exact(channels).take(width * height).map(pixel).collect();
        if pixels.len() != width * height {
            return Err(MapError::new("picture", MapProblem::Png("it ends too early".to_owned())));
        }
        Ok(Picture { width, height, pixels })
    }

    /// Paints every pixel's label, as far as the legend knows one.
    pub(super) fn paint(&self, canvas: &mut Canvas, legend: &Legend) -> Result<(), MapError> {
        let mut unknown: Option<(usize, [u8; 4])> = None;
        let mut missing = 0;
        let mut last: Option<([u8; 4], u8)> = None;
        for (i, &pixel) in self.pixels.iter().enumerate() {
            let index = match last {
                Some((same, index)) if same == pixel => index,
                _ => {
                    let label = match legend.label(pixel) {
                        Some(label) => label,
                        None => {
                            missing += 1;
                            unknown.get_or_insert((i, pixel));
                            continue;
                        }
                    };
                    let letter = label.map_or(Labels::EMPTY, Labels::only);
                    let index = canvas.colour(letter).map_err(|problem| MapError::new("image", problem))?;
                    last = Some((pixel, index));
                    index
                }
            };
            canvas.indices[i] = index;
        }
        let Some((i, [r, g, b, _])) = unknown else { return Ok(()) };
        let place = format!("pixel ({}, {})", i % self.width, i / self.width);
        let colour = format!("#{r:02x}{g:02x}{b:02x}");
        Err(MapError::new(place, MapProblem::UnknownColour { colour, pixels: missing, total: self.pixels.len() }))
    }

    /// Labels for the colours of a flat picture, in the order in which they appear: black, grey and white are free ground, red is
    /// `unsafe`, every other colour is a label with its name (`green`, `blue`, …; a second shade of the same name gets a number).
    /// Transparent pixels do not count.
    pub(super) fn guess_labels(&self) -> Result<Guess, MapError> {
        let mut colours: Vec<[u8; 3]> = vec![];
        for &[r, g, b, opacity] in &self.pixels {
            if opacity >= 128 && !colours.contains(&[r, g, b]) {
                colours.push([r, g, b]);
                if colours.len() >= FLAT {
                    return Err(MapError::new("picture", MapProblem::NotFlat(FLAT)));
                }
            }
        }
        let mut names: Vec<String> = vec![];
        let mut entries = vec![];
        for colour in colours {
            let [low, high] = [colour.iter().min(), colour.iter().max()].map(|c| *c.expect("three channels"));
            let mut label = None;
            if high - low >= 24 {
                let name = colour_name(colour);
                let same = names.iter().filter(|n| n.trim_end_matches(|c: char| c.is_ascii_digit()) == name).count();
                // All reds are one label; of the other colours, each shade is its own.
                let numbered = if same == 0 || name == "unsafe" { name.to_owned() } else { format!("{name}{}", same + 1) };
                if !names.contains(&numbered) {
                    names.push(numbered.clone());
                }
                label = Some(numbered);
            }
            entries.push((colour, label));
        }
        Ok((names, entries))
    }
}

impl Legend {
    /// The label of a pixel, `Some(None)` for free ground, `None` for an unknown colour. Transparent pixels are free ground.
    fn label(&self, [r, g, b, opacity]: [u8; 4]) -> Option<Option<usize>> {
        if opacity < 128 {
            return Some(None);
        }
        let distance = |colour: [u8; 3]| {
            let off = [r, g, b].into_iter().zip(colour).map(|(a, b)| a.abs_diff(b));
            off.max().expect("three channels")
        };
        let nearest = self.colours.iter().map(|&(colour, label)| (distance(colour), label)).min_by_key(|entry| entry.0);
        match nearest {
            Some((distance, label)) if distance <= self.tolerance => Some(label),
            _ if self.others_free => Some(None),
            _ => None,
        }
    }
}

/// The nearest of ten colours; red is `unsafe`.
fn colour_name(colour: [u8; 3]) -> &'static str {
    const NAMES: [([i32; 3], &str); 12] = [
        ([255, 0, 0], "unsafe"),
        ([0, 255, 0], "green"),
        ([0, 128, 0], "green"),
        ([0, 0, 255], "blue"),
        ([0, 0, 128], "blue"),
        ([255, 255, 0], "yellow"),
        ([0, 255, 255], "cyan"),
        ([255, 0, 255], "magenta"),
        ([255, 165, 0], "orange"),
        ([128, 0, 128], "purple"),
        ([165, 42, 42], "brown"),
        ([255, 192, 203], "pink"),
    ];
    let distance = |other: [i32; 3]| -> i32 { (0..3).map(|i| (i32::from(colour[i]) - other[i]).pow(2)).sum() };
    NAMES.into_iter().min_by_key(|(other, _)| distance(*other)).expect("there are names").1
}
