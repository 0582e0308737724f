//! Legacy VTK files, as text or binary (big endian): surfaces as they are, of volumes the outer surface.

mod attributes;
mod data;
mod reader;
mod topology;
mod write;

use data::Data;
use reader::{DataSet, Owner, Reader};
use topology::Layout;

use super::assembly::{check_count, check_length};
use super::cells::{Cells, kind};
use super::format::{Format, Writer};
use super::mesh_data::{MeshData, MeshFormat};
use super::scan::{Scanner, excerpt, push, require, reserve};
use crate::error::ParseError;

pub(super) const FORMAT: Format = Format {
    name: "vtk",
    extensions: &["vtk"],
    description: "VTK legacy data sets, text or binary, with fields; of volumes the outer surface",
    sniff: |bytes| starts_right(first_line(bytes).1),
    read,
    write: Some(Writer { text: true, binary: true, fields: true, write: write::write }),
};

/// How a file of this format starts.
const MAGIC: &[u8] = b"# vtk DataFile";

fn first_line(bytes: &[u8]) -> (Scanner<'_>, &[u8]) {
    let mut text = Scanner::new(bytes);
    text.next_row();
    let line = text.rest_of_line();
    (text, line)
}

fn starts_right(line: &[u8]) -> bool {
    line.get(..MAGIC.len()).is_some_and(|start| start.eq_ignore_ascii_case(MAGIC))
}

/// Reads a legacy VTK file. Arrays of the points become fields, those of the cells fields of triangles; of an array `v` with several
/// components each becomes a field `v_0`, `v_1`, …
fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let (mut text, first) = first_line(bytes);
    if !starts_right(first) {
        return Err(text.syntax("a VTK file starts with `# vtk DataFile Version`"));
    }
    // The title, which may be empty.
    text.rest_of_line();
    let encoding = text.word().ok_or_else(|| text.unexpected_end("`ASCII` or `BINARY`"))?;
    let binary = encoding.eq_ignore_ascii_case(b"binary");
    if !binary && !encoding.eq_ignore_ascii_case(b"ascii") {
        return Err(text.syntax(format!("`ASCII` or `BINARY` should stand here, not `{}`", excerpt(encoding))));
    }
    text.rest_of_line();
    let mut reader = Reader::new(Data { text, binary });
    while let Some(keyword) = reader.data.text.word() {
        reader.section(&keyword.to_ascii_uppercase())?;
    }
    reader.make_grid()?;
    if reader.points.is_none() {
        return Err(ParseError::MissingElement { element: "vertices".to_owned() });
    }
    reader.assembly.finish(MeshFormat::Vtk)
}

impl Reader<'_> {
    /// Reads what follows a keyword.
    fn section(&mut self, keyword: &[u8]) -> Result<(), ParseError> {
        match keyword {
            b"DATASET" => self.read_data_set(),
            b"POINTS" => self.read_points(),
            b"POLYGONS" => {
                self.is_in_order &= !self.has_strips;
                self.read_cells(Layout::Polygons, "polygons")
            }
            b"TRIANGLE_STRIPS" => {
                self.has_strips = true;
                self.read_cells(Layout::Strips, "strips")
            }
            b"VERTICES" => self.read_cells(Layout::Skipped, "vertex cells"),
            b"LINES" => self.read_cells(Layout::Skipped, "lines"),
            b"CELLS" => self.read_cells(Layout::Kept, "cells"),
            b"CELL_TYPES" => self.read_types(),
            b"DIMENSIONS" => {
                for axis in 0..3 {
                    self.size[axis] = self.data.text.count_in_row("the number of points")?;
                }
                Ok(())
            }
            b"ORIGIN" | b"SPACING" | b"ASPECT_RATIO" => {
                let mut numbers = [0.0; 3];
                for number in &mut numbers {
                    *number = self.data.text.number("a coordinate")?;
                }
                if keyword == b"ORIGIN" {
                    self.origin = numbers;
                } else {
                    self.spacing = numbers;
                }
                Ok(())
            }
            b"X_COORDINATES" => self.read_axis(0),
            b"Y_COORDINATES" => self.read_axis(1),
            b"Z_COORDINATES" => self.read_axis(2),
            b"POINT_DATA" => {
                self.make_grid()?;
                let count = self.data.text.count_in_row("the number of points")?;
                check_length("POINT_DATA", self.points.unwrap_or(0), count)?;
                self.owner = Owner::Points(count);
                Ok(())
            }
            b"CELL_DATA" => {
                self.make_grid()?;
                self.owner = Owner::Cells(self.data.text.count_in_row("the number of cells")?);
                Ok(())
            }
            b"METADATA" => {
                // It ends with an empty line.
                self.data.text.rest_of_line();
                while !self.data.text.rest().is_empty() && !self.data.text.rest_of_line().trim_ascii().is_empty() {}
                Ok(())
            }
            b"FIELD" => self.read_field_data(),
            _ => self.attribute(keyword),
        }
    }

    fn read_data_set(&mut self) -> Result<(), ParseError> {
        let kind = self.data.text.name_in_row("the kind of data set")?;
        self.data_set = match kind.to_ascii_uppercase().as_slice() {
            b"POLYDATA" => DataSet::PolyData,
            b"UNSTRUCTURED_GRID" => DataSet::Unstructured,
            b"STRUCTURED_GRID" => DataSet::Structured,
            b"RECTILINEAR_GRID" => DataSet::Rectilinear,
            b"STRUCTURED_POINTS" => DataSet::Image,
            _ => {
                let format = MeshFormat::Vtk.name().to_owned();
                return Err(ParseError::UnsupportedFeature { format, feature: format!("DATASET {}", excerpt(kind)) });
            }
        };
        Ok(())
    }

    fn read_points(&mut self) -> Result<(), ParseError> {
        let count = self.data.text.count_in_row("the number of points")?;
        let kind = self.data.array_type()?;
        if self.points.replace(count).is_some() {
            return Err(self.data.text.syntax("POINTS stands twice"));
        }
        check_count("vertices", count)?;
        let block = self.data.block(kind, count.saturating_mul(3))?;
        let positions = &mut self.assembly.positions;
        reserve(positions, count as usize * 3)?;
        self.data.numbers(&block, &mut |value| positions.push(value))?;
        Ok(())
    }

    fn read_axis(&mut self, axis: usize) -> Result<(), ParseError> {
        let count = self.data.text.count_in_row("the number of coordinates")?;
        let kind = self.data.array_type()?;
        let block = self.data.block(kind, count)?;
        let values = &mut self.axes[axis];
        values.clear();
        reserve(values, count as usize)?;
        self.data.numbers(&block, &mut |value| values.push(value))
    }

    /// Makes the points and cells of a grid, once all of it is known: before the first data, or at the end.
    fn make_grid(&mut self) -> Result<(), ParseError> {
        if self.cells.is_some() || matches!(self.data_set, DataSet::PolyData | DataSet::Unstructured) {
            return Ok(());
        }
        let count = self.size.iter().fold(1_u64, |product, &count| product.saturating_mul(count));
        check_count("vertices", count)?;
        if self.data_set == DataSet::Structured {
            check_length("POINTS", count, self.points.unwrap_or(0))?;
        } else {
            // There is a number for each point, or there would be no use for the grid.
            require(count, self.data.text.rest().len())?;
            for axis in 0..3 {
                if self.data_set == DataSet::Image {
                    let (origin, spacing) = (self.origin[axis], self.spacing[axis]);
                    reserve(&mut self.axes[axis], self.size[axis] as usize)?;
                    self.axes[axis].extend((0..self.size[axis]).map(|place| origin + spacing * place as f64));
                }
                check_length("coordinates", self.size[axis], self.axes[axis].len() as u64)?;
            }
            reserve(&mut self.assembly.positions, 3 * count as usize)?;
            let [xs, ys, zs] = &self.axes;
            for &z in zs {
                for &y in ys {
                    self.assembly.positions.extend(xs.iter().flat_map(|&x| [x, y, z]));
                }
            }
            self.points = Some(count);
        }
        self.cells = Some(Cells::of_grid(&mut self.assembly, self.size)?);
        Ok(())
    }

    /// Reads the types of the cells of an unstructured grid, and then knows its cells.
    fn read_types(&mut self) -> Result<(), ParseError> {
        let count = self.data.text.count_in_row("the number of types")?;
        let Some(connectivity) = self.connectivity.take() else {
            return Err(self.data.text.syntax("CELL_TYPES stand before CELLS"));
        };
        check_length("CELL_TYPES", connectivity.count(), count)?;
        let mut types = Vec::new();
        self.data.integers(super::cursor::NumberType::I32, count, &mut |value| push(&mut types, value))?;
        let has_volumes = types.iter().any(|&number| kind(number).is_volume());
        let mut cells = Cells::new(self.points.unwrap_or(0), has_volumes);
        for (place, &number) in types.iter().enumerate() {
            cells.add(&mut self.assembly, number, connectivity.corners_of(place))?;
        }
        drop((connectivity, types));
        cells.finish(&mut self.assembly)?;
        self.cells = Some(cells);
        Ok(())
    }
}
