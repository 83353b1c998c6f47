//! The map file as it is written: JSON, every key known.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MapFile {
    pub name: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub about: String,
    pub unit: String,
    pub width: f32,
    pub height: f32,
    pub reach: f32,
    pub labels: Vec<LabelEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hazard: Option<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<RegionEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell: Option<f32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub picture: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<ImageEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grid: Option<GridEntry>,
}

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LabelEntry {
    pub name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub meaning: Option<String>,
}

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RegionEntry {
    pub label: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub disc: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub polygon: Option<Vec<[f32; 2]>>,
}

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ImageEntry {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    pub colours: BTreeMap<String, Option<String>>,
    #[serde(default)]
    pub tolerance: u8,
    #[serde(default)]
    pub others: Others,
}

#[derive(Clone, Copy, PartialEq, Default, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Others {
    #[default]
    Refuse,
    Free,
}

/// Cells written out: runs of `[letter, cells]` row by row, letters as lists of labels.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GridEntry {
    pub columns: usize,
    pub rows: usize,
    pub letters: Vec<Vec<String>>,
    pub runs: Vec<[u32; 2]>,
}
