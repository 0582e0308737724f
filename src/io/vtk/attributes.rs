//! Arrays of a legacy VTK file: of the points, of the cells, of the file.

use super::super::arrays::Components;
use super::super::cursor::NumberType;
use super::super::names::decode_name;
use super::super::number::parse_count;
use super::super::scan::excerpt;
use super::data::ArrayType;
use super::reader::{Owner, Reader};
use crate::error::ParseError;

impl Reader<'_> {
    /// Reads an attribute of the points, or of the cells.
    pub(super) fn attribute(&mut self, keyword: &[u8]) -> Result<(), ParseError> {
        let unknown = || self.data.text.syntax(format!("unknown keyword `{}`", excerpt(keyword)));
        let count = match self.owner {
            Owner::Points(count) | Owner::Cells(count) => count,
            Owner::File if keyword == b"LOOKUP_TABLE" => 0,
            Owner::File => return Err(unknown()),
        };
        if !matches!(
            keyword,
            b"SCALARS"
                | b"VECTORS"
                | b"NORMALS"
                | b"TENSORS"
                | b"TENSORS6"
                | b"TEXTURE_COORDINATES"
                | b"COLOR_SCALARS"
                | b"LOOKUP_TABLE"
                | b"GLOBAL_IDS"
                | b"PEDIGREE_IDS"
                | b"EDGE_FLAGS"
        ) {
            return Err(unknown());
        }
        let name = decode_name(self.data.text.name_in_row("the name")?);
        match keyword {
            b"COLOR_SCALARS" => {
                let components = self.data.text.count_in_row("the number of color components")?;
                // Colors are fractions in text and bytes in binary files.
                let scale = if self.data.binary { 255.0 } else { 1.0 };
                self.read_array(&name, ArrayType::Number(NumberType::U8), components, count, scale)
            }
            b"LOOKUP_TABLE" => {
                let size = self.data.text.count_in_row("the size of the table")?;
                self.data.skip(ArrayType::Number(NumberType::U8), size.saturating_mul(4))?;
                self.assembly.skipped(format!("lookup table `{name}`"), size.saturating_mul(4));
                Ok(())
            }
            b"GLOBAL_IDS" | b"PEDIGREE_IDS" | b"EDGE_FLAGS" => {
                let kind = self.data.array_type()?;
                self.data.skip(kind, count)?;
                self.assembly.skipped(format!("ids or flags `{name}`"), count);
                Ok(())
            }
            b"TEXTURE_COORDINATES" => {
                let components = self.data.text.count_in_row("the number of texture coordinates")?;
                let kind = self.data.array_type()?;
                self.read_array(&name, kind, components, count, 1.0)
            }
            b"SCALARS" => {
                let kind = self.data.array_type()?;
                let components = match self.data.text.word_in_row() {
                    Some(word) => parse_count(word).ok_or_else(|| self.data.text.invalid_number(word))?,
                    None => 1,
                };
                // The name of a table that colors the values; some writers leave it out.
                if self.data.text.peek_word().is_some_and(|word| word.eq_ignore_ascii_case(b"LOOKUP_TABLE")) {
                    self.data.text.word();
                    self.data.text.word_in_row();
                }
                self.read_array(&name, kind, components, count, 1.0)
            }
            _ => {
                let kind = self.data.array_type()?;
                let components = match keyword {
                    b"TENSORS" => 9,
                    b"TENSORS6" => 6,
                    _ => 3,
                };
                self.read_array(&name, kind, components, count, 1.0)
            }
        }
    }

    /// `FIELD name n` and n arrays: fields where they belong to the points or cells.
    pub(super) fn read_field_data(&mut self) -> Result<(), ParseError> {
        self.data.text.name_in_row("the name")?;
        let arrays = self.data.text.count_in_row("the number of arrays")?;
        for _ in 0..arrays {
            let mut name = self.data.text.word().ok_or_else(|| self.data.text.unexpected_end("an array"))?;
            while name.eq_ignore_ascii_case(b"METADATA") {
                self.section(b"METADATA")?;
                name = self.data.text.word().ok_or_else(|| self.data.text.unexpected_end("an array"))?;
            }
            let name = decode_name(name);
            let components = self.data.text.count_in_row("the number of components")?;
            let tuples = self.data.text.count_in_row("the number of tuples")?;
            let kind = self.data.array_type()?;
            self.read_array(&name, kind, components, tuples, 1.0)?;
        }
        Ok(())
    }

    /// Reads an array into one field for each component, of values that are divided by `scale`. Passes over it where it has no place.
    fn read_array(
        &mut self,
        name: &str,
        kind: ArrayType,
        components: u64,
        tuples: u64,
        scale: f64,
    ) -> Result<(), ParseError> {
        let size = components.saturating_mul(tuples);
        let (of, wanted) = match self.owner {
            Owner::File => ("of the file", None),
            Owner::Points(count) => ("of the points", Some(count)),
            Owner::Cells(_) => ("of the cells", Some(self.cell_count()).filter(|_| self.is_in_order)),
        };
        if wanted != Some(tuples) || kind == ArrayType::Text || size == 0 {
            self.data.skip(kind, size)?;
            if size > 0 {
                let length = wanted.filter(|&wanted| wanted != tuples);
                let why = length.map_or_else(String::new, |wanted| format!(", with {tuples} tuples for {wanted},"));
                self.assembly.skipped(format!("array `{name}` {of}{why}"), size);
            }
            return Ok(());
        }
        let block = self.data.block(kind, size)?;
        let mut array = Components::new(name, components, tuples)?;
        if kind.is_real() && scale == 1.0 {
            array = array.with_magnitude();
        }
        self.data.numbers(&block, &mut |value| array.push(value / scale))?;
        let Self { owner, assembly, cells, lines, .. } = self;
        if let Owner::Points(_) = owner {
            return array.finish(&mut |name, values| assembly.field(name, values));
        }
        let mut result = Ok(());
        let lines = *lines as usize;
        array.finish(&mut |name, mut values| match cells {
            Some(cells) => {
                let added = cells.field(assembly, name, &values);
                result = core::mem::replace(&mut result, Ok(())).and(added);
            }
            None => {
                values.drain(..lines);
                assembly.face_field(name, values);
            }
        })?;
        result
    }
}
