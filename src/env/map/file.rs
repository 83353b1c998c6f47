//! From a map file, a picture, or both, to a checked [`RoverMap`].

use super::error::{MapError, MapProblem};
use super::format::{GridEntry, ImageEntry, LabelEntry, MapFile, Others, RegionEntry};
use super::grid::{LabelGrid, Run};
use super::picture::{Legend, MAX_SIDE, Picture};
use super::raster::Canvas;
use crate::env::scene::{Region, Shape};
use crate::labels::{Labels, Propositions};

/// The longest map file, in bytes.
pub const MAX_TEXT: usize = 4 << 20;
/// The largest number of regions.
pub const MAX_REGIONS: usize = 1_000;
/// The largest number of corners of all polygons together.
pub const MAX_POINTS: usize = 100_000;

/// The two maps of the paper, and a small one for its worked example, as map files.
const SHIPPED: [(&str, &str); 3] = [
    ("melas", include_str!("../../../assets/melas.json")),
    ("victoria", include_str!("../../../assets/victoria.json")),
    ("three_targets", include_str!("../../../assets/three_targets.json")),
];

/// A checked map: its size, its labels, its regions and the grid of letters made of them.
#[derive(Clone, PartialEq, Debug)]
pub struct RoverMap {
    /// What the map is called.
    pub name: String,
    /// The unit of length.
    pub unit: String,
    /// Width and height.
    pub size: [f32; 2],
    /// D, the longest way of one step.
    pub reach: f32,
    /// The propositions.
    pub propositions: Propositions,
    /// A sentence for each proposition.
    pub meanings: Vec<String>,
    /// The proposition that wins over all others, if there is one.
    pub hazard: Option<usize>,
    /// The file of a picture that fills the map.
    pub picture: Option<String>,
    /// The regions, for views.
    pub regions: Vec<Region>,
    /// The letters.
    pub grid: LabelGrid,
    /// What it was made of.
    file: MapFile,
}

impl RoverMap {
    /// The text of a shipped map file, `melas`, `victoria` or `three_targets`; `None` for other names.
    pub fn shipped(name: &str) -> Option<&'static str> {
        SHIPPED.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
    }

    /// The names of the shipped maps.
    pub fn shipped_names() -> impl Iterator<Item = &'static str> {
        SHIPPED.iter().map(|(name, _)| *name)
    }

    /// Reads a map file; `image` is the PNG whose colours are labels, needed exactly if the file has the key `image`.
    ///
    /// # Errors
    /// [`MapError`] names the place and what is allowed there.
    pub fn from_json(text: &str, image: Option<&[u8]>) -> Result<RoverMap, MapError> {
        RoverMap::from_json_and_picture(text, image.map(Picture::from_png).transpose()?.as_ref())
    }

    /// As [`RoverMap::from_json`], for a picture that is decoded already.
    ///
    /// # Errors
    /// As [`RoverMap::from_json`].
    pub fn from_json_and_picture(text: &str, picture: Option<&Picture>) -> Result<RoverMap, MapError> {
        let file = parse(text)?;
        match (&file.image, picture) {
            (Some(_), Some(_)) | (None, None) => {}
            (Some(_), None) => {
                return Err(MapError::new("image", MapProblem::Image("the map takes labels from a picture, and there is none")));
            }
            (None, Some(_)) => {
                let problem = "there is a picture, and the map file does not say what its colours mean";
                return Err(MapError::new("image", MapProblem::Image(problem)));
            }
        }
        build(file, picture)
    }

    /// A map from a flat PNG alone: one pixel is one unit (`px`), a step reaches 1.5 % of the longer side. Transparent, black, grey
    /// and white pixels are free ground, red ones are `unsafe`, and every other colour is a label called by its name (`green`,
    /// `blue`, `yellow`, `cyan`, `magenta`, `orange`, `purple`, `brown`, `pink`; further shades get numbers: `green2`).
    ///
    /// # Errors
    /// A picture that cannot be read, is too large, is not flat, or leaves no free ground.
    pub fn from_png(name: &str, bytes: &[u8]) -> Result<RoverMap, MapError> {
        RoverMap::from_picture(name, &Picture::from_png(bytes)?)
    }

    /// As [`RoverMap::from_png`], for a picture that is decoded already.
    ///
    /// # Errors
    /// As [`RoverMap::from_png`].
    pub fn from_picture(name: &str, picture: &Picture) -> Result<RoverMap, MapError> {
        limit("picture", "pixels on a side", picture.width.max(picture.height), MAX_SIDE)?;
        if picture.width == 0 || picture.height == 0 || picture.pixels.len() != picture.width * picture.height {
            return Err(MapError::new("picture", MapProblem::Image("it has no pixels, or not as many as its size says")));
        }
        let (width, height) = (picture.width as f32, picture.height as f32);
        let (names, colours) = picture.guess_labels()?;
        let meaning = |name: &String| format!("the rover is on a pixel of the colour {name}");
        let labels = names.iter().map(|name| LabelEntry { name: name.clone(), meaning: Some(meaning(name)) }).collect();
        let colours = colours.into_iter().map(|([r, g, b], label)| (format!("#{r:02x}{g:02x}{b:02x}"), label)).collect();
        let file = MapFile {
            name: name.to_owned(),
            about: String::new(),
            unit: "px".to_owned(),
            width,
            height,
            reach: 0.015 * width.max(height),
            labels,
            hazard: None,
            regions: vec![],
            cell: None,
            picture: None,
            image: Some(ImageEntry { file: None, colours, tolerance: 0, others: Others::Refuse }),
            grid: None,
        };
        build(file, Some(picture))
    }

    /// The name of the picture whose colours are the labels, if the map file `text` names one (`image.file`): for whoever may read
    /// files, to hand its bytes to [`RoverMap::from_json`].
    ///
    /// # Errors
    /// A text that is no map file.
    pub fn image_file(text: &str) -> Result<Option<String>, MapError> {
        Ok(parse(text)?.image.and_then(|image| image.file))
    }

    /// The map as one map file that needs no picture to be read again: labels taken from a picture are written out as `grid`.
    pub fn to_json(&self) -> String {
        let mut file = self.file.clone();
        if file.image.take().is_some() {
            // The regions are in the grid as well.
            file.regions.clear();
            let letters = self.grid.letters().map(|letter| {
                let names = self.propositions.iter().enumerate().filter(|(i, _)| letter.holds(*i));
                names.map(|(_, name)| name.to_owned()).collect()
            });
            let [columns, rows] = self.grid.size();
            file.grid = Some(GridEntry { columns, rows, letters: letters.collect(), runs: self.grid.letter_runs() });
        }
        serde_json::to_string(&file).expect("a map file has a form in JSON")
    }
}

fn parse(text: &str) -> Result<MapFile, MapError> {
    limit("map file", "bytes", text.len(), MAX_TEXT)?;
    serde_json::from_str(text).map_err(|error| {
        let place = format!("line {}, column {}", error.line(), error.column());
        let sentence = error.to_string();
        let problem = sentence.rsplit_once(" at line ").map_or(sentence.as_str(), |(problem, _)| problem);
        MapError::new(place, MapProblem::Syntax(problem.to_owned()))
    })
}

fn limit(place: &str, what: &'static str, found: usize, limit: usize) -> Result<(), MapError> {
    if found > limit { Err(MapError::new(place, MapProblem::TooMany { what, found, limit })) } else { Ok(()) }
}

fn positive(place: &str, value: f32) -> Result<(), MapError> {
    let ok = value.is_finite() && value > 0.0 && value <= 1e9;
    let problem = MapProblem::OutOfRange { value: value.into(), range: "greater than 0, and at most 10⁹" };
    if ok { Ok(()) } else { Err(MapError::new(place, problem)) }
}

fn build(file: MapFile, image: Option<&Picture>) -> Result<RoverMap, MapError> {
    let size = [file.width, file.height];
    for (place, value) in [("width", file.width), ("height", file.height), ("reach", file.reach)] {
        positive(place, value)?;
    }
    let names = file.labels.iter().map(|label| label.name.clone());
    let propositions = Propositions::new(names).map_err(|error| MapError::new("labels", error.into()))?;
    let hazard = match &file.hazard {
        Some(label) => Some(find(&propositions, label, "hazard")?),
        None => propositions.index("unsafe"),
    };
    let mut regions = regions(&file.regions, &propositions)?;
    let mut canvas = canvas(&file, size, image, &propositions)?;
    for (i, region) in regions.iter().enumerate() {
        let painted = canvas.paint(&region.shape, region.proposition);
        painted.map_err(|problem| MapError::new(format!("regions[{i}]"), problem))?;
    }
    if let Some(hazard) = hazard {
        canvas.let_win(hazard);
    }
    let grid = LabelGrid::new(size, canvas.cells(), canvas.palette, canvas.indices, hazard)
        .ok_or_else(|| MapError::new("map", MapProblem::NoFreeGround))?;
    if file.image.is_some() || file.grid.is_some() {
        regions = cell_regions(&grid, &propositions);
    }
    let meaning = |entry: &LabelEntry| entry.meaning.clone().unwrap_or_else(|| format!("the rover is in `{}`", entry.name));
    let meanings = file.labels.iter().map(meaning).collect();
    let MapFile { name, unit, reach, picture, .. } = file.clone();
    Ok(RoverMap { name, unit, size, reach, propositions, meanings, hazard, picture, regions, grid, file })
}

/// The cells before any region is painted: free ground, or the labels of a picture or of cells written out.
fn canvas(file: &MapFile, size: [f32; 2], image: Option<&Picture>, propositions: &Propositions) -> Result<Canvas, MapError> {
    match (&file.image, &file.grid, image) {
        (Some(_), Some(_), _) => Err(MapError::new("grid", MapProblem::Image("a map has an `image` or a `grid`, not both"))),
        (Some(entry), None, Some(picture)) => {
            let mut canvas = Canvas::new(size, [picture.width, picture.height]);
            picture.paint(&mut canvas, &legend(entry, propositions)?)?;
            Ok(canvas)
        }
        (_, Some(grid), _) => written_out(grid, size, propositions),
        _ => Ok(Canvas::new(size, cells(size, file.cell)?)),
    }
}

fn written_out(grid: &GridEntry, size: [f32; 2], propositions: &Propositions) -> Result<Canvas, MapError> {
    let total = grid.columns.saturating_mul(grid.rows);
    limit("grid", "grid cells", total, LabelGrid::MAX_CELLS)?;
    positive("grid.columns", grid.columns as f32)?;
    positive("grid.rows", grid.rows as f32)?;
    let mut canvas = Canvas::new(size, [grid.columns, grid.rows]);
    let mut colours = vec![];
    for (i, names) in grid.letters.iter().enumerate() {
        let mut letter = Labels::EMPTY;
        for name in names {
            letter = letter.with(find(propositions, name, &format!("grid.letters[{i}]"))?, true);
        }
        colours.push(canvas.colour(letter).map_err(|problem| MapError::new("grid.letters", problem))?);
    }
    let mut at = 0_usize;
    for (i, &[letter, length]) in grid.runs.iter().enumerate() {
        let end = at.saturating_add(length as usize);
        let (Some(&colour), true) = (colours.get(letter as usize), end <= total) else {
            let problem = MapProblem::Image("there is no such letter, or the runs have more cells than the grid");
            return Err(MapError::new(format!("grid.runs[{i}]"), problem));
        };
        canvas.indices[at..end].fill(colour);
        at = end;
    }
    if at < total {
        return Err(MapError::new("grid.runs", MapProblem::Image("the runs have fewer cells than the grid")));
    }
    Ok(canvas)
}

fn find(propositions: &Propositions, label: &str, place: &str) -> Result<usize, MapError> {
    propositions.index(label).ok_or_else(|| {
        let quoted: Vec<String> = propositions.iter().map(|name| format!("`{name}`")).collect();
        let near = propositions.iter().min_by_key(|name| strsim::damerau_levenshtein(name, label));
        let near = near.filter(|name| strsim::damerau_levenshtein(name, label) <= 2);
        let problem = MapProblem::UnknownLabel {
            label: label.to_owned(),
            available: if quoted.is_empty() { "none".to_owned() } else { quoted.join(", ") },
            suggestion: near.map_or(String::new(), |name| format!(" (did you mean `{name}`?)")),
        };
        MapError::new(place, problem)
    })
}

/// Columns and rows: cells of the given side, by default a thousandth of the longer side.
fn cells(size: [f32; 2], cell: Option<f32>) -> Result<[usize; 2], MapError> {
    let cell = cell.unwrap_or(size[0].max(size[1]) / 1_000.0);
    positive("cell", cell)?;
    let count = size.map(|side| libm::ceilf(side / cell).max(1.0));
    let total = f64::from(count[0]) * f64::from(count[1]);
    limit("cell", "grid cells", total.min(1e18) as usize, LabelGrid::MAX_CELLS)?;
    Ok(count.map(|n| n as usize))
}

fn regions(entries: &[RegionEntry], propositions: &Propositions) -> Result<Vec<Region>, MapError> {
    limit("regions", "regions", entries.len(), MAX_REGIONS)?;
    let points = entries.iter().filter_map(|entry| entry.polygon.as_ref()).map(Vec::len).sum();
    limit("regions", "corners", points, MAX_POINTS)?;
    let region = |(i, entry): (usize, &RegionEntry)| {
        let place = format!("regions[{i}]");
        let proposition = find(propositions, &entry.label, &format!("{place}.label"))?;
        let coordinates = |values: &[f32], key: &str| match values.iter().find(|v| v.is_nan() || v.abs() > 1e9) {
            None => Ok(()),
            Some(&value) => {
                let problem = MapProblem::OutOfRange { value: value.into(), range: "between −10⁹ and 10⁹" };
                Err(MapError::new(format!("{place}.{key}"), problem))
            }
        };
        let shape = match (entry.disc, &entry.polygon) {
            (Some([x, y, radius]), None) => {
                coordinates(&[x, y], "disc")?;
                positive(&format!("{place}.disc[2]"), radius)?;
                Shape::Disc { centre: [x, y], radius }
            }
            (None, Some(points)) => {
                coordinates(points.as_flattened(), "polygon")?;
                if points.len() < 3 {
                    return Err(MapError::new(format!("{place}.polygon"), MapProblem::Corners(points.len())));
                }
                Shape::Polygon { points: points.clone() }
            }
            _ => return Err(MapError::new(place, MapProblem::Shape)),
        };
        Ok(Region { proposition, name: entry.name.clone(), shape, margin: 0.0 })
    };
    entries.iter().enumerate().map(region).collect()
}

fn legend(entry: &ImageEntry, propositions: &Propositions) -> Result<Legend, MapError> {
    let mut colours = vec![];
    for (colour, label) in &entry.colours {
        let place = format!("image.colours.{colour}");
        let digits = colour.strip_prefix('#').filter(|digits| digits.len() == 6 && digits.is_ascii());
        let value = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
        let Some(value) = value else { return Err(MapError::new(place, MapProblem::Colour(colour.clone()))) };
        let [_, r, g, b] = value.to_be_bytes();
        let label = label.as_ref().map(|label| find(propositions, label, &place)).transpose()?;
        colours.push(([r, g, b], label));
    }
    Ok(Legend { colours, tolerance: entry.tolerance, others_free: entry.others == Others::Free })
}

/// The cells of each label as one region, for maps that come from pictures.
fn cell_regions(grid: &LabelGrid, propositions: &Propositions) -> Vec<Region> {
    let region = |(proposition, name): (usize, &str)| {
        let runs = grid.runs_of(proposition).into_iter().map(|Run { row, column, length }| [row, column, length]).collect();
        let shape = Shape::Cells { cell: grid.cell(), runs };
        Region { proposition, name: name.to_owned(), shape, margin: 0.0 }
    };
    let occurs = |p: usize| grid.letters().any(|letter: Labels| letter.holds(p));
    propositions.iter().enumerate().filter(|(p, _)| occurs(*p)).map(region).collect()
}
