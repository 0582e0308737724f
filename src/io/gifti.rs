//! GIFTI: surfaces of brains and values on them, in XML.

use super::arrays::Components;
use super::assembly::{Assembly, check_count};
use super::cursor::{Cursor, NumberType};
use super::format::Format;
use super::mesh_data::{MeshData, MeshFormat};
use super::number::parse_number;
use super::packed::{base64, damaged, inflate, most_unpacked};
use super::scan::{Scanner, push, require, reserve};
use super::xml::{self, Document, Element, Part};
use crate::error::ParseError;

pub(super) const FORMAT: Format = Format {
    name: "gii",
    extensions: &["gii"],
    description: "GIFTI: surfaces, and values on them as fields or tables",
    sniff: is_gifti,
    read,
    write: None,
};

pub(super) fn is_gifti(bytes: &[u8]) -> bool {
    xml::starts_with(bytes, b"<GIFTI")
}

/// An array as it is declared.
struct DataArray<'a> {
    intent: String,
    name: Option<String>,
    kind: NumberType,
    rows: u64,
    columns: u64,
    by_columns: bool,
    encoding: String,
    big_endian: bool,
    data: &'a [u8],
}

impl DataArray<'_> {
    fn new(element: &Element) -> Result<Self, ParseError> {
        let text = |name: &str| element.attribute(name).unwrap_or_default().to_owned();
        let kind = match text("DataType").as_str() {
            "NIFTI_TYPE_UINT8" => NumberType::U8,
            "NIFTI_TYPE_INT8" => NumberType::I8,
            "NIFTI_TYPE_INT16" => NumberType::I16,
            "NIFTI_TYPE_UINT16" => NumberType::U16,
            "NIFTI_TYPE_INT32" => NumberType::I32,
            "NIFTI_TYPE_UINT32" => NumberType::U32,
            "NIFTI_TYPE_INT64" => NumberType::I64,
            "NIFTI_TYPE_UINT64" => NumberType::U64,
            "NIFTI_TYPE_FLOAT32" => NumberType::F32,
            "NIFTI_TYPE_FLOAT64" => NumberType::F64,
            other => return Err(unsupported(format!("values of the type `{other}`"))),
        };
        let mut columns = 1_u64;
        for dimension in 1..element.count("Dimensionality")?.unwrap_or(1).min(6) {
            columns = columns.saturating_mul(element.count(&format!("Dim{dimension}"))?.unwrap_or(1));
        }
        Ok(Self {
            intent: text("Intent"),
            name: None,
            kind,
            rows: element.count("Dim0")?.unwrap_or(0),
            columns,
            by_columns: text("ArrayIndexingOrder") == "ColumnMajorOrder",
            encoding: text("Encoding"),
            big_endian: text("Endian") == "BigEndian",
            data: &[],
        })
    }

    /// All numbers, row by row.
    fn numbers(&self, length: usize) -> Result<Vec<f64>, ParseError> {
        let count = self.rows.saturating_mul(self.columns);
        let mut values = Vec::new();
        let size = count.saturating_mul(self.kind.size());
        match self.encoding.as_str() {
            "ASCII" => {
                let mut text = Scanner::new(self.data);
                text.require_numbers(count)?;
                reserve(&mut values, count as usize)?;
                for _ in 0..count {
                    let word = text.word().ok_or_else(|| damaged("an array has too few numbers"))?;
                    values.push(parse_number(word).ok_or_else(|| text.invalid_number(word))?);
                }
            }
            "Base64Binary" => {
                require(size, self.data.len())?;
                self.decode(&base64(self.data, size as usize)?, count, &mut values)?;
            }
            "GZipBase64Binary" => {
                let packed = base64(self.data, usize::MAX)?;
                let most = most_unpacked(length);
                if size > most {
                    return Err(ParseError::TooLarge { element: "unpacked bytes".to_owned(), count: size });
                }
                let mut bytes = Vec::new();
                inflate(&packed, &mut bytes, Some(size as usize), most, true)?;
                self.decode(&bytes, count, &mut values)?;
            }
            other => return Err(unsupported(format!("data in the encoding `{other}`"))),
        }
        if self.by_columns && self.columns > 1 && self.rows > 1 {
            let mut turned = Vec::new();
            reserve(&mut turned, values.len())?;
            for row in 0..self.rows as usize {
                turned.extend((0..self.columns as usize).map(|column| values[column * self.rows as usize + row]));
            }
            values = turned;
        }
        Ok(values)
    }

    fn decode(&self, bytes: &[u8], count: u64, values: &mut Vec<f64>) -> Result<(), ParseError> {
        require(count.saturating_mul(self.kind.size()), bytes.len())?;
        reserve(values, count as usize)?;
        let mut data = Cursor::new(bytes, self.big_endian);
        for _ in 0..count {
            values.push(data.number(self.kind)?);
        }
        Ok(())
    }

    /// What a field of it is called.
    fn title(&self) -> String {
        let intent = self.intent.strip_prefix("NIFTI_INTENT_").unwrap_or(&self.intent).to_ascii_lowercase();
        self.name.clone().filter(|name| !name.is_empty()).unwrap_or(intent)
    }

    fn is(&self, intent: &str) -> bool {
        self.intent.strip_prefix("NIFTI_INTENT_") == Some(intent)
    }
}

fn arrays(bytes: &[u8]) -> Result<Vec<DataArray<'_>>, ParseError> {
    let mut document = Document::new(bytes);
    let mut arrays: Vec<DataArray<'_>> = Vec::new();
    // The element that text belongs to, and the key of a pair that is being read.
    let (mut inside, mut key, mut is_in_array) = (String::new(), String::new(), false);
    while let Some(part) = document.next()? {
        match part {
            Part::Start(element) => {
                if element.name == "DataArray" {
                    push(&mut arrays, DataArray::new(&element)?)?;
                    is_in_array = true;
                }
                inside = element.name;
            }
            Part::End(name) => {
                is_in_array &= name != "DataArray";
                inside.clear();
            }
            Part::Text(text) => {
                let Some(array) = arrays.last_mut().filter(|_| is_in_array) else { continue };
                match inside.as_str() {
                    "Data" => array.data = text,
                    "Name" => key = String::from_utf8_lossy(text.trim_ascii()).into_owned(),
                    "Value" if key == "Name" => {
                        array.name = Some(String::from_utf8_lossy(text.trim_ascii()).into_owned());
                    }
                    _ => {}
                }
            }
        }
    }
    Ok(arrays)
}

fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let arrays = arrays(bytes)?;
    let missing = |element: &str| ParseError::MissingElement { element: element.to_owned() };
    let points = arrays.iter().find(|array| array.is("POINTSET")).ok_or_else(|| missing("vertices"))?;
    let faces = arrays.iter().find(|array| array.is("TRIANGLE")).ok_or_else(|| missing("faces"))?;
    if points.columns != 3 || faces.columns != 3 {
        return Err(damaged("vertices and faces should have three numbers each"));
    }
    check_count("vertices", points.rows)?;
    let mut assembly = Assembly::default();
    assembly.positions = points.numbers(bytes.len())?;
    assembly.reserve_triangles(faces.rows.min(bytes.len() as u64))?;
    for corners in faces.numbers(bytes.len())?.chunks_exact(3) {
        for &corner in corners {
            let id = if corner.fract() == 0.0 { corner as i64 } else { -1 };
            assembly.corner(id, points.rows)?;
        }
        assembly.close_polygon()?;
    }
    for array in arrays.iter().filter(|array| !array.is("POINTSET") && !array.is("TRIANGLE")) {
        let title = array.title();
        if array.rows == points.rows {
            columns_of(array, bytes.len(), |name, values| assembly.field(name, values))?;
        } else {
            assembly.skipped(format!("array `{title}` of {} values", array.rows), array.rows);
        }
    }
    if arrays.iter().filter(|array| array.is("POINTSET")).count() > 1 {
        assembly.skipped("all surfaces but the first", 1);
    }
    assembly.finish(MeshFormat::Gii)
}

fn columns_of(array: &DataArray<'_>, length: usize, mut take: impl FnMut(&str, Vec<f64>)) -> Result<(), ParseError> {
    let values = array.numbers(length)?;
    if values.is_empty() {
        return Ok(());
    }
    let mut parts = Components::new(&array.title(), array.columns, array.rows)?;
    values.into_iter().for_each(|value| parts.push(value));
    parts.finish(&mut take)
}

/// Reads the values of an overlay, every array as a column.
pub(super) fn read_columns(bytes: &[u8]) -> Result<Vec<(String, Vec<f64>)>, ParseError> {
    let mut columns = Vec::new();
    for array in arrays(bytes)?.iter().filter(|array| !array.is("TRIANGLE")) {
        columns_of(array, bytes.len(), |name, values| columns.push((name.to_owned(), values)))?;
    }
    Ok(columns)
}

fn unsupported(feature: String) -> ParseError {
    ParseError::UnsupportedFeature { format: MeshFormat::Gii.name().to_owned(), feature }
}
