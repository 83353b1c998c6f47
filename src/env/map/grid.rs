//! The label grid: one letter per cell, looked up in constant time; and the free ground where episodes start.

use crate::labels::Labels;

/// A rectangle of cells over a map, each with the letter of its centre. At most 256 different letters occur.
#[derive(Clone, PartialEq, Debug)]
pub struct LabelGrid {
    columns: usize,
    rows: usize,
    /// Cells per unit of length, in x and y.
    density: [f32; 2],
    /// Size of a cell, in the map's unit.
    cell: [f32; 2],
    palette: Vec<Labels>,
    /// Indices into the palette, row by row from the top.
    cells: Vec<u8>,
    starts: Starts,
}

/// The cells where an episode may start, as horizontal runs.
#[derive(Clone, PartialEq, Default, Debug)]
struct Starts {
    runs: Vec<Run>,
    /// Per run: how many cells the runs before it have.
    before: Vec<u32>,
    total: u32,
}

/// Neighbouring cells of one row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Run {
    pub row: u32,
    pub column: u32,
    pub length: u32,
}

impl LabelGrid {
    /// The largest number of cells: 16 million.
    pub const MAX_CELLS: usize = 1 << 24;

    /// The grid over a map of the given size, and where to start on it; `None` if no cell is free.
    ///
    /// Starts are cells without label from which every label but `hazard` that occurs on the map can be reached, side by side over
    /// cells without `hazard`; all cells without label if there is no such cell. `cells` index `palette`, row by row.
    pub(super) fn new(
        size: [f32; 2],
        [columns, rows]: [usize; 2],
        palette: Vec<Labels>,
        cells: Vec<u8>,
        hazard: Option<usize>,
    ) -> Option<LabelGrid> {
        assert_eq!(cells.len(), columns * rows, "one index per cell");
        let density = [columns as f32 / size[0], rows as f32 / size[1]];
        let cell = [size[0] / columns as f32, size[1] / rows as f32];
        let mut grid = LabelGrid { columns, rows, density, cell, palette, cells, starts: Starts::default() };
        let connected = grid.connected(hazard);
        let all = grid.runs(|grid, i| grid.palette[grid.cells[i] as usize] == Labels::EMPTY && connected[i]);
        grid.starts = Starts::new(all);
        (grid.starts.total > 0).then_some(grid)
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.columns, self.rows]
    }

    /// Width and height of a cell, in the map's unit.
    pub fn cell(&self) -> [f32; 2] {
        self.cell
    }

    /// The letter at (x, y), in the map's unit from the top-left corner: that of the nearest cell's centre.
    pub fn labels(&self, x: f32, y: f32) -> Labels {
        // A cast of a negative float or NaN gives 0.
        let column = ((x * self.density[0]) as usize).min(self.columns - 1);
        let row = ((y * self.density[1]) as usize).min(self.rows - 1);
        self.palette[self.cells[row * self.columns + column] as usize]
    }

    /// All letters that occur.
    pub fn letters(&self) -> impl Iterator<Item = Labels> {
        self.palette.iter().copied()
    }

    /// The letter of each cell, as an index into [`LabelGrid::letters`], row by row from the top.
    pub fn indices(&self) -> &[u8] {
        &self.cells
    }

    /// How many cells have the label `index`.
    pub fn area(&self, index: usize) -> usize {
        let holds: Vec<bool> = self.palette.iter().map(|letter| letter.holds(index)).collect();
        self.cells.iter().filter(|&&cell| holds[cell as usize]).count()
    }

    /// The place in the ground free for starts that stands at `share` (in `[0, 1)`) of it, at the fractions `inside` (in `[0, 1)`) of
    /// its cell: uniform numbers give a uniform place.
    pub(in crate::env) fn start(&self, share: f32, inside: [f32; 2]) -> [f32; 2] {
        let Starts { runs, before, total } = &self.starts;
        let k = ((f64::from(share) * f64::from(*total)) as u32).min(total - 1);
        let run = before.partition_point(|&count| count <= k) - 1;
        let Run { row, column, .. } = runs[run];
        let column = column + (k - before[run]);
        [(column as f32 + inside[0]) * self.cell[0], (row as f32 + inside[1]) * self.cell[1]]
    }

    /// How many cells an episode may start in.
    pub fn start_cells(&self) -> usize {
        self.starts.total as usize
    }

    /// All cells row by row, as runs of (index into [`LabelGrid::letters`], cells).
    pub(super) fn letter_runs(&self) -> Vec<[u32; 2]> {
        let mut runs: Vec<[u32; 2]> = vec![];
        for &cell in &self.cells {
            match runs.last_mut() {
                Some([letter, length]) if *letter == u32::from(cell) => *length += 1,
                _ => runs.push([u32::from(cell), 1]),
            }
        }
        runs
    }

    /// The runs of cells in which the label `index` holds.
    pub(super) fn runs_of(&self, index: usize) -> Vec<Run> {
        self.runs(|grid, i| grid.palette[grid.cells[i] as usize].holds(index))
    }

    fn runs(&self, chosen: impl Fn(&LabelGrid, usize) -> bool) -> Vec<Run> {
        let mut runs: Vec<Run> = vec![];
        for row in 0..self.rows {
            let mut open = false;
            for column in 0..self.columns {
                let inside = chosen(self, row * self.columns + column);
                match runs.last_mut() {
                    Some(run) if inside && open => run.length += 1,
                    _ if inside => runs.push(Run { row: row as u32, column: column as u32, length: 1 }),
                    _ => {}
                }
                open = inside;
            }
        }
        runs
    }

    /// Per cell, whether it lies in a connected piece of ground without `hazard` in which every other label of the map occurs; if
    /// no piece is like that, every cell without `hazard`.
    fn connected(&self, hazard: Option<usize>) -> Vec<bool> {
        let letters = self.palette.iter().fold(0, |all, letter| all | letter.0);
        let wanted = hazard.map_or(letters, |h| letters & !(1 << h));
        let passable: Vec<bool> = self.palette.iter().map(|letter| !hazard.is_some_and(|h| letter.holds(h))).collect();
        let passable = |i: usize| passable[self.cells[i] as usize];
        let mut chosen = vec![false; self.cells.len()];
        let mut seen = vec![false; self.cells.len()];
        let mut any = false;
        for first in 0..self.cells.len() {
            if seen[first] || !passable(first) {
                continue;
            }
            let (mut piece, mut next, mut found) = (vec![first], 0, 0);
            seen[first] = true;
            while let Some(&i) = piece.get(next) {
                next += 1;
                found |= self.palette[self.cells[i] as usize].0;
                let column = i % self.columns;
                let beside = [
                    (column > 0).then(|| i - 1),
                    (column + 1 < self.columns).then(|| i + 1),
                    i.checked_sub(self.columns),
                    (i + self.columns < self.cells.len()).then_some(i + self.columns),
                ];
                for j in beside.into_iter().flatten() {
                    if !seen[j] && passable(j) {
                        seen[j] = true;
                        piece.push(j);
                    }
                }
            }
            if found & wanted == wanted {
                any = true;
                piece.into_iter().for_each(|i| chosen[i] = true);
            }
        }
        if any { chosen } else { (0..self.cells.len()).map(passable).collect() }
    }
}

impl Starts {
    fn new(runs: Vec<Run>) -> Starts {
        let mut total = 0;
        let count = |run: &Run| {
            let before = total;
            total += run.length;
            before
        };
        let before = runs.iter().map(count).collect();
        Starts { runs, before, total }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of unit cells from rows of characters: `.` free, digits label 0 … 8, `#` label 9, the hazard.
    fn grid(rows: &[&str]) -> LabelGrid {
        let letter = |c: char| match c {
            '.' => Labels::EMPTY,
            '#' => Labels::only(9),
            digit => Labels::only(digit.to_digit(10).unwrap() as usize),
        };
        let (mut palette, mut cells) = (vec![], vec![]);
        for c in rows.iter().flat_map(|row| row.chars()) {
            let letter = letter(c);
            let index = palette.iter().position(|&l| l == letter).unwrap_or_else(|| {
                palette.push(letter);
                palette.len() - 1
            });
            cells.push(index as u8);
        }
        let size = [rows[0].len(), rows.len()];
        LabelGrid::new(size.map(|n| n as f32), size, palette, cells, Some(9)).unwrap()
    }

    #[test]
    fn the_nearest_cell_answers_and_the_border_belongs_to_the_map() {
        let grid = grid(&["0.1", "..#"]);
        for (x, y, labels) in [
            (0.0, 0.0, Labels::only(0)),
            (0.99, 0.99, Labels::only(0)),
            (1.0, 0.5, Labels::EMPTY),
            (2.5, 0.5, Labels::only(1)),
            (3.0, 0.0, Labels::only(1)),
            (3.0, 2.0, Labels::only(9)),
            (-1.0, f32::NAN, Labels::only(0)),
            (f32::INFINITY, 9.0, Labels::only(9)),
        ] {
            assert_eq!(grid.labels(x, y), labels, "({x}, {y})");
        }
        assert_eq!((grid.area(0), grid.area(9)), (1, 1));
    }

    #[test]
    fn starts_are_free_cells_from_which_all_labels_can_be_reached() {
        // The right part is cut off from label 0, the corner below from both.
        let grid = grid(&["0.1#..1", "...#...", ".###.##", "####.#."]);
        assert_eq!(grid.start_cells(), 1 + 3 + 1);
        let found: Vec<[f32; 2]> = (0..5).map(|k| grid.start((k as f32 + 0.5) / 5.0, [0.5, 0.5])).collect();
        assert_eq!(found, [[1.5, 0.5], [0.5, 1.5], [1.5, 1.5], [2.5, 1.5], [0.5, 2.5]]);
        assert_eq!(grid.start(0.999_999, [0.0, 0.0]), [0.0, 2.0]);
    }

    #[test]
    fn without_a_connected_piece_every_free_cell_is_a_start() {
        let grid = grid(&["0.#.1"]);
        assert_eq!(grid.start_cells(), 2);
    }

    #[test]
    fn runs_cover_exactly_the_cells_of_a_label() {
        let runs = grid(&["0.00", "0...", "0000"]).runs_of(0);
        let found: Vec<_> = runs.iter().map(|run| (run.row, run.column, run.length)).collect();
        assert_eq!(found, [(0, 0, 1), (0, 2, 2), (1, 0, 1), (2, 0, 4)]);
    }
}
