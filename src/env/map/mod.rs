//! Label maps for the rover: regions or flat colours become, once, a grid of letters with look-up in constant time.
//!
//! [`RoverMap::from_json`] reads the map file (below), [`RoverMap::from_png`] a picture alone, [`RoverMap::shipped`] the two maps of
//! [Cai et al. 2021](crate::bib::Cai2021), section V-B. Where the hazard label holds, no other label does: unsafe wins.
//!
//! ```json
//! {
//!   "name": "Two rocks", "unit": "m", "width": 100, "height": 60, "reach": 1.5,
//!   "labels": [{"name": "goal", "meaning": "the flag is in sight"}, {"name": "unsafe"}],
//!   "regions": [
//!     {"label": "goal", "disc": [80, 30, 6]},
//!     {"label": "unsafe", "name": "big rock", "polygon": [[20, 10], [40, 12], [30, 40]]}
//!   ]
//! }
//! ```
//!
//! | key | meaning | default |
//! |---|---|---|
//! | `name` | what the map is called | – |
//! | `about` | a remark | none |
//! | `unit` | unit of length of all numbers | – |
//! | `width`, `height` | size of the map; the origin is the top-left corner, x grows to the right, y downwards | – |
//! | `reach` | D, the longest way of one step | – |
//! | `labels` | the propositions in order, each with an optional `meaning` | – |
//! | `hazard` | the label that wins over all others | `unsafe`, if there is such a label |
//! | `regions` | shapes: `disc` (x, y, radius) or `polygon` (corners, even-odd) | none |
//! | `cell` | side of a grid cell | a thousandth of the longer side |
//! | `picture` | the file of a picture that fills the map, for views | none |
//! | `image` | labels from the flat colours of a PNG: `file`, `colours`, `tolerance`, `others` | none |
//! | `grid` | labels by cell, as [`RoverMap::to_json`] writes them: `columns`, `rows`, `letters`, `runs` | none |
//!
//! In `image`, `colours` maps `"#rrggbb"` to a label or to `null` for free ground; a pixel takes the nearest colour whose channels
//! all differ by at most `tolerance` (0 … 255, default 0); other colours are an error (`"others": "refuse"`) or free ground
//! (`"others": "free"`). The grid then has the picture's pixels for cells.

mod error;
mod file;
mod format;
mod grid;
mod picture;
mod raster;

pub use error::{MapError, MapProblem};
pub use file::{MAX_POINTS, MAX_REGIONS, MAX_TEXT, RoverMap};
pub use grid::LabelGrid;
pub use picture::{MAX_SIDE, Picture};
