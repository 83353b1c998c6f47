//! Why a map cannot be used, and where in it.

/// Why a map cannot be used.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[error("{place}: {problem}")]
pub struct MapError {
    /// Where: `line 3, column 8`, `regions[4].disc`, `pixel (3, 9)`.
    pub place: String,
    /// What is wrong there.
    pub problem: MapProblem,
}

/// What is wrong with a map.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MapProblem {
    /// Not JSON, an unknown or missing key, a value of another type.
    #[error("{0}")]
    Syntax(String),
    /// More of something than is allowed.
    #[error("{found} {what}; at most {limit} are allowed")]
    TooMany {
        /// Of what.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many are allowed.
        limit: usize,
    },
    /// A number outside its range.
    #[error("{value} is not allowed; it must be {range}")]
    OutOfRange {
        /// The number.
        value: f64,
        /// What is allowed.
        range: &'static str,
    },
    /// A label that is not in the list of labels.
    #[error("there is no label `{label}`; the labels are {available}{suggestion}")]
    UnknownLabel {
        /// The label.
        label: String,
        /// The list.
        available: String,
        /// A near name, as a question; empty if there is none.
        suggestion: String,
    },
    /// A list of labels that is no alphabet.
    #[error("{0}")]
    Labels(#[from] crate::labels::PropositionsError),
    /// A region that has not exactly one shape.
    #[error("a region has either a `disc` or a `polygon`")]
    Shape,
    /// Fewer than three corners.
    #[error("a polygon has at least 3 corners, this one has {0}")]
    Corners(usize),
    /// A colour that is not written as `#rrggbb`.
    #[error("`{0}` is no colour; write it as #rrggbb")]
    Colour(String),
    /// The map file has `image` but there is no picture, or the other way round.
    #[error("{0}")]
    Image(&'static str),
    /// Not a PNG file that can be read.
    #[error("the picture cannot be read: {0}")]
    Png(String),
    /// A colour that the legend does not name.
    #[error(
        "the colour {colour} is not in the legend, and neither are those of {pixels} of {total} pixels; add it, raise \
         `tolerance`, or set \"others\": \"free\""
    )]
    UnknownColour {
        /// The colour, as `#rrggbb`.
        colour: String,
        /// How many pixels have unknown colours.
        pixels: usize,
        /// How many pixels there are.
        total: usize,
    },
    /// A picture without legend whose colours are not flat.
    #[error(
        "{0} different colours or more: the picture is not flat (perhaps smoothed, or once a JPEG); draw it without smoothing, or \
         give a map file with a legend and a `tolerance`"
    )]
    NotFlat(usize),
    /// Nowhere to start.
    #[error("no ground is free of labels, so there is nowhere to start")]
    NoFreeGround,
    /// Labels overlap in more different ways than a grid can hold.
    #[error("the labels overlap in more than 256 different ways")]
    TooManyOverlaps,
}

impl MapError {
    pub(super) fn new(place: impl Into<String>, problem: MapProblem) -> MapError {
        MapError { place: place.into(), problem }
    }
}
