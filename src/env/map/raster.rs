//! Painting shapes onto cells: a cell belongs to a shape if its centre does.

use super::error::MapProblem;
use crate::env::scene::Shape;
use crate::labels::Labels;

/// Cells under the brush. The palette grows with the overlaps that occur.
pub(super) struct Canvas {
    size: [f64; 2],
    columns: usize,
    rows: usize,
    pub palette: Vec<Labels>,
    /// Indices into the palette, row by row.
    pub indices: Vec<u8>,
}

impl Canvas {
    /// Free ground: `cells` columns and rows over `size` units of length.
    pub fn new(size: [f32; 2], cells: [usize; 2]) -> Canvas {
        let [columns, rows] = cells;
        Canvas { size: size.map(f64::from), columns, rows, palette: vec![Labels::EMPTY], indices: vec![0; columns * rows] }
    }

    /// Columns and rows.
    pub fn cells(&self) -> [usize; 2] {
        [self.columns, self.rows]
    }

    /// Adds the label `index` to all cells of `shape`.
    pub fn paint(&mut self, shape: &Shape, index: usize) -> Result<(), MapProblem> {
        self.repaint(shape, |letter| letter.with(index, true))
    }

    /// Leaves only the label `index` wherever it holds.
    pub fn let_win(&mut self, index: usize) {
        for letter in &mut self.palette {
            if letter.holds(index) {
                *letter = Labels::only(index);
            }
        }
        // Letters that have become equal, or that are hidden everywhere, leave the palette.
        let mut used = [false; 256];
        self.indices.iter().for_each(|&cell| used[cell as usize] = true);
        let (mut palette, mut renumbered) = (vec![], [0_u8; 256]);
        for (old, &letter) in self.palette.iter().enumerate().filter(|(old, _)| used[*old]) {
            let new = palette.iter().position(|&l| l == letter).unwrap_or_else(|| {
                palette.push(letter);
                palette.len() - 1
            });
            renumbered[old] = new as u8;
        }
        self.indices.iter_mut().for_each(|cell| *cell = renumbered[*cell as usize]);
        self.palette = palette;
    }

    /// The palette's index of a letter, new if need be.
    pub fn colour(&mut self, letter: Labels) -> Result<u8, MapProblem> {
        let index = self.palette.iter().position(|&l| l == letter).unwrap_or(self.palette.len());
        if index == self.palette.len() {
            self.palette.push(letter);
        }
        u8::try_from(index).map_err(|_| MapProblem::TooManyOverlaps)
    }

    fn repaint(&mut self, shape: &Shape, change: impl Fn(Labels) -> Labels) -> Result<(), MapProblem> {
        let mut changed: [Option<u8>; 256] = [None; 256];
        for row in 0..self.rows {
            for (from, to) in self.spans(shape, (row as f64 + 0.5) * self.size[1] / self.rows as f64) {
                for column in self.columns_between(from, to) {
                    let i = row * self.columns + column;
                    let old = self.indices[i] as usize;
                    self.indices[i] = match changed[old] {
                        Some(new) => new,
                        None => self.colour(change(self.palette[old]))?,
                    };
                    changed[old] = Some(self.indices[i]);
                }
            }
        }
        Ok(())
    }

    /// The columns whose centres lie in `[from, to]`.
    fn columns_between(&self, from: f64, to: f64) -> std::ops::Range<usize> {
        let per_unit = self.columns as f64 / self.size[0];
        // Column i has its centre at (i + 0.5) / per_unit; casts of negative numbers give 0.
        let first = libm::ceil(from * per_unit - 0.5) as usize;
        let end = (libm::floor(to * per_unit - 0.5) + 1.0) as usize;
        first..end.min(self.columns)
    }

    /// The pieces of the horizontal line at `y` that lie in `shape`, as intervals of x.
    fn spans(&self, shape: &Shape, y: f64) -> Vec<(f64, f64)> {
        match shape {
            Shape::Disc { centre, radius } => {
                let (dy, radius) = (y - f64::from(centre[1]), f64::from(*radius));
                let half = libm::sqrt(radius * radius - dy * dy);
                let x = f64::from(centre[0]);
                if half.is_nan() { vec![] } else { vec![(x - half, x + half)] }
            }
            Shape::Polygon { points } => {
                let mut crossings = vec![];
                for (i, &[x, top]) in points.iter().enumerate() {
                    let [to_x, bottom] = points[(i + 1) % points.len()].map(f64::from);
                    let (x, top) = (f64::from(x), f64::from(top));
                    // Half-open, so that a corner on the line counts once.
                    if (top <= y) != (bottom <= y) {
                        crossings.push(x + (y - top) / (bottom - top) * (to_x - x));
                    }
                }
                crossings.sort_unstable_by(f64::total_cmp);
                crossings.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
            }
            // Bands and cells are no shapes of a map file.
            Shape::Band { .. } | Shape::Cells { .. } => vec![],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(shape: &Shape) -> Vec<Vec<bool>> {
        let mut canvas = Canvas::new([20.0, 10.0], [40, 20]);
        canvas.paint(shape, 3).unwrap();
        canvas.indices.chunks(40).map(|row| row.iter().map(|&c| canvas.palette[c as usize].holds(3)).collect()).collect()
    }

    #[test]
    fn a_cell_belongs_to_a_disc_if_its_centre_does() {
        for (row, line) in cells(&Shape::Disc { centre: [1.0, 9.0], radius: 2.3 }).iter().enumerate() {
            for (column, &painted) in line.iter().enumerate() {
                let (x, y) = (column as f64 * 0.5 + 0.25 - 1.0, row as f64 * 0.5 + 0.25 - 9.0);
                assert_eq!(painted, x * x + y * y <= 2.3_f64 * 2.3, "{column}, {row}");
            }
        }
    }

    #[test]
    fn polygons_follow_the_even_odd_rule() {
        // A pentagram drawn in one line has a hole in the middle; its centre is (10, 5).
        let points = (0..5).map(|k| {
            let angle = f32::from(k as u8) * 4.0 * std::f32::consts::PI / 5.0;
            [10.0 + 4.8 * angle.sin(), 5.0 - 4.8 * angle.cos()]
        });
        let found = cells(&Shape::Polygon { points: points.collect() });
        assert!(!found[10][20], "the middle is crossed twice");
        assert!(found[2][20], "the upper point");
        assert!(!found[0][0] && !found[19][20]);
    }

    #[test]
    fn the_hazard_hides_other_labels() {
        let mut canvas = Canvas::new([4.0, 1.0], [4, 1]);
        let strip = |from: f32, to: f32| Shape::Polygon { points: vec![[from, 0.0], [to, 0.0], [to, 1.0], [from, 1.0]] };
        canvas.paint(&strip(0.0, 3.0), 0).unwrap();
        canvas.paint(&strip(1.0, 3.0), 1).unwrap();
        canvas.paint(&strip(2.0, 4.0), 2).unwrap();
        canvas.let_win(2);
        let found: Vec<u64> = canvas.indices.iter().map(|&c| canvas.palette[c as usize].0).collect();
        assert_eq!(found, [0b001, 0b011, 0b100, 0b100]);
        assert_eq!(canvas.palette.len(), 3, "letters that occur nowhere are forgotten");
    }
}
