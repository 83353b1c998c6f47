//! Pictures of results, drawn with plotters: values with intervals in rows, and curves with bands.

use super::text::{count, percent};
use crate::cli::curves::{COLOURS, font};
use crate::cli::failure::Failure;
use crate::eval::Interval;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::path::Path;

/// A row of [`dots`].
#[derive(Clone, PartialEq, Debug)]
pub struct Dots {
    /// What it is about.
    pub label: String,
    /// Index into the palette.
    pub colour: usize,
    /// The large dot.
    pub middle: f64,
    /// The bar.
    pub interval: Interval,
    /// The small dots.
    pub values: Vec<f64>,
}

/// What a row's numbers are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Scale {
    /// Shares from 0 to 1.
    Share,
    /// Counts of steps, on a logarithmic scale.
    Steps,
}

impl Scale {
    fn place(self, value: f64) -> f64 {
        match self {
            Scale::Share => value,
            Scale::Steps => value.max(1.0).log10(),
        }
    }

    fn label(self, place: f64) -> String {
        match self {
            Scale::Share => percent(place),
            Scale::Steps => count(10f64.powf(place)),
        }
    }

    fn range(self, rows: &[Dots]) -> std::ops::Range<f64> {
        match self {
            Scale::Share => -0.02..1.02,
            Scale::Steps => {
                let all = || rows.iter().flat_map(|row| &row.values).map(|&v| self.place(v));
                (all().fold(f64::INFINITY, f64::min) - 0.1)..(all().fold(0.0, f64::max) + 0.1)
            }
        }
    }
}

/// A curve with a band around it.
#[derive(Clone, PartialEq, Debug)]
pub struct Band {
    /// For the legend.
    pub name: String,
    /// Index into the palette.
    pub colour: usize,
    /// (x, middle, low, high).
    pub points: Vec<[f64; 4]>,
}

/// Draws `rows` from the top down into the SVG file `out`.
///
/// # Errors
/// If it cannot be written.
pub fn dots(out: &Path, scale: Scale, title: &str, rows: &[Dots]) -> Result<(), Failure> {
    let height = 70 + 28 * rows.len() as u32;
    save(out, (960, height), |area| {
        let n = rows.len() as f64;
        let mut chart = ChartBuilder::on(area)
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(230)
            .build_cartesian_2d(scale.range(rows), 0.0..n)?;
        chart
            .configure_mesh()
            .disable_y_mesh()
            .disable_y_axis()
            .max_light_lines(0)
            .x_desc(title)
            .x_label_formatter(&|x| scale.label(*x))
            .draw()?;
        for (i, row) in rows.iter().enumerate() {
            let y = n - i as f64 - 0.5;
            let colour = COLOURS[row.colour % COLOURS.len()];
            let [low, middle, high] = [row.interval.low, row.middle, row.interval.high].map(|v| scale.place(v));
            chart.draw_series([PathElement::new([(low, y), (high, y)], colour.stroke_width(3))])?;
            chart.draw_series(row.values.iter().map(|&v| Circle::new((scale.place(v), y), 3, colour.mix(0.5).filled())))?;
            chart.draw_series([Circle::new((middle, y), 6, colour.filled())])?;
            let at = chart.backend_coord(&(scale.range(rows).start, y));
            area.draw_text(&row.label, &("sans-serif", 14).into_text_style(area), (16, at.1 - 7))?;
        }
        Ok(())
    })
}

/// Draws `bands` into the SVG file `out`.
///
/// # Errors
/// If it cannot be written.
pub fn bands(out: &Path, (x, y): (&str, &str), bands: &[Band]) -> Result<(), Failure> {
    let all = || bands.iter().flat_map(|band| &band.points);
    let last = all().map(|p| p[0]).fold(1.0, f64::max);
    let (low, high) = all().fold((0.0f64, 0.0f64), |(low, high), p| (low.min(p[2]), high.max(p[3])));
    let room = if high > low { 0.05 * (high - low) } else { 1.0 };
    save(out, (960, 480), |area| {
        let mut chart = ChartBuilder::on(area)
            .margin(16)
            .x_label_area_size(44)
            .y_label_area_size(76)
            .build_cartesian_2d(0.0..last, low - room..high + room)?;
        chart.configure_mesh().x_desc(x).y_desc(y).light_line_style(WHITE).x_label_formatter(&|x| count(*x)).draw()?;
        for band in bands {
            let colour = COLOURS[band.colour % COLOURS.len()];
            let above = band.points.iter().map(|p| (p[0], p[3]));
            let below = band.points.iter().rev().map(|p| (p[0], p[2]));
            chart.draw_series([Polygon::new(above.chain(below).collect::<Vec<_>>(), colour.mix(0.18))])?;
            let style = colour.stroke_width(2);
            chart
                .draw_series(LineSeries::new(band.points.iter().map(|p| (p[0], p[1])), style))?
                .label(&band.name)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], style));
        }
        chart.configure_series_labels().background_style(WHITE.mix(0.8)).border_style(BLACK).draw()?;
        Ok(())
    })
}

type Drawn = Result<(), Box<dyn std::error::Error>>;

fn save(out: &Path, size: (u32, u32), draw: impl FnOnce(&DrawingArea<SVGBackend<'_>, Shift>) -> Drawn) -> Result<(), Failure> {
    font()?;
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        let drawn = area.fill(&WHITE).map_err(Into::into).and_then(|()| draw(&area));
        drawn.and_then(|()| area.present().map_err(Into::into)).map_err(|e| Failure::file(out, e))?;
    }
    crate::cli::files::write(out, text)
}
