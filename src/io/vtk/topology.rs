//! Cells of a legacy VTK file: their corners in either layout.

use super::super::assembly::{Assembly, check_count};
use super::super::cursor::NumberType;
use super::super::scan::push;
use super::reader::{Connectivity, Reader};
use crate::error::ParseError;

/// What cells become.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Layout {
    Polygons,
    Strips,
    /// Points and lines.
    Skipped,
    /// Cells whose types are not known yet.
    Kept,
}

/// Where corners go.
struct Sink<'a> {
    layout: Layout,
    vertices: u64,
    assembly: &'a mut Assembly,
    kept: Connectivity,
}

impl Sink<'_> {
    fn corner(&mut self, value: i64) -> Result<(), ParseError> {
        match self.layout {
            Layout::Polygons | Layout::Strips => self.assembly.corner(value, self.vertices),
            Layout::Skipped => Ok(()),
            Layout::Kept => push(&mut self.kept.corners, value),
        }
    }

    fn close(&mut self) -> Result<(), ParseError> {
        match self.layout {
            Layout::Polygons => self.assembly.close_polygon(),
            Layout::Strips => self.assembly.close_strip(),
            Layout::Skipped => Ok(()),
            Layout::Kept => push(&mut self.kept.ends, self.kept.corners.len()),
        }
    }
}

impl Reader<'_> {
    /// Reads cells of either layout.
    pub(super) fn read_cells(&mut self, layout: Layout, what: &str) -> Result<(), ParseError> {
        let first = self.data.text.count_in_row("the number of cells")?;
        let second = self.data.text.count_in_row("the number of ids")?;
        let Some(vertices) = self.points else {
            return Err(self.data.text.syntax(format!("{what} stand before POINTS")));
        };
        let offsets = self.data.text.peek_word().is_some_and(|word| word.eq_ignore_ascii_case(b"OFFSETS"));
        // The assembly is handed to the sink while the data are read.
        let mut assembly = core::mem::take(&mut self.assembly);
        let mut sink = Sink { layout, vertices, assembly: &mut assembly, kept: Connectivity::default() };
        let cells = if offsets {
            self.read_offset_cells(&mut sink, first, second)?
        } else {
            self.read_counted_cells(&mut sink, first, second)?
        };
        let kept = sink.kept;
        self.assembly = assembly;
        match layout {
            Layout::Kept => self.connectivity = Some(kept),
            Layout::Skipped => {
                self.lines += cells;
                if cells > 0 {
                    self.assembly.skipped(format!("{cells} {what}"), cells);
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Every cell is its number of corners and then its corners.
    fn read_counted_cells(&mut self, sink: &mut Sink<'_>, cells: u64, size: u64) -> Result<u64, ParseError> {
        check_count("cells", cells)?;
        let line = self.data.text.line();
        let mut left = 0;
        let mut found = 0;
        self.data.integers(NumberType::I32, size, &mut |value| {
            if left > 0 {
                left -= 1;
                sink.corner(value)?;
            } else {
                left = u64::try_from(value).map_err(|_| ParseError::InvalidSyntax {
                    line,
                    problem: format!("cell {found} has {value} corners"),
                })?;
                found += 1;
            }
            if left == 0 {
                sink.close()?;
            }
            Ok(())
        })?;
        if left != 0 || found != cells {
            let problem = format!("{cells} cells with {size} numbers were announced, but they do not add up");
            return Err(ParseError::InvalidSyntax { line, problem });
        }
        Ok(cells)
    }

    /// Version 5: where every cell starts, and then all corners.
    fn read_offset_cells(&mut self, sink: &mut Sink<'_>, offset_count: u64, corners: u64) -> Result<u64, ParseError> {
        check_count("cells", offset_count)?;
        let line = self.data.text.line();
        self.data.text.word();
        let id_type = self.data.integer_type()?;
        // One byte or more for each is there, or this fails before the vector grows.
        let mut offsets = Vec::new();
        self.data.integers(id_type, offset_count, &mut |value| push(&mut offsets, value))?;
        if !self.data.text.word().is_some_and(|word| word.eq_ignore_ascii_case(b"CONNECTIVITY")) {
            return Err(self.data.text.syntax("CONNECTIVITY should follow OFFSETS"));
        }
        let id_type = self.data.integer_type()?;
        let rising = offsets.windows(2).all(|pair| pair[0] <= pair[1]);
        let ends = (offsets.first().copied().unwrap_or(0), offsets.last().copied().unwrap_or(0));
        if !rising || ends != (0, i64::try_from(corners).unwrap_or(i64::MAX)) {
            let problem = format!("the offsets should rise from 0 to {corners}");
            return Err(ParseError::InvalidSyntax { line, problem });
        }
        let mut ends = offsets.iter().skip(1).peekable();
        let mut read = 0;
        self.data.integers(id_type, corners, &mut |value| {
            // Cells without corners end where they start.
            while ends.next_if(|&&end| end <= read).is_some() {
                sink.close()?;
            }
            sink.corner(value)?;
            read += 1;
            Ok(())
        })?;
        for _ in ends {
            sink.close()?;
        }
        Ok(offset_count.saturating_sub(1))
    }
}
