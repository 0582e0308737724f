//! Reading and writing files.

use super::detail::{Detail, NameList};
use super::stage::stage_error;

stage_error! {
    /// A file could not be read.
    ParseError {
        /// There are no bytes.
        EmptyFile {} => "the file is empty",
        /// Neither the option, the content nor the file name tells the format.
        UnknownFormat {
            /// What the content seems to be.
            seems: String,
            /// The names of all formats.
            formats: String,
        } => "this is no format that can be read; it seems to be {seems}. The formats are: {formats}",
        /// The format is known but not built yet.
        UnsupportedFormat {
            /// Its name.
            format: String,
        } => "reading or writing `{format}` is not supported",
        /// The format is known, but not this variety of it.
        UnsupportedFeature {
            /// The format's name.
            format: String,
            /// What the file holds or asks for.
            feature: String,
        } => "`{format}` files with {feature} are not supported",
        /// The file ends before what its header promises.
        Truncated {
            /// Bytes that the header asks for, from the place where they should start.
            expected: u64,
            /// Bytes that are there.
            available: u64,
        } => "the file is truncated: {expected} bytes are needed where {available} are left",
        /// A text file ends before what its header promises.
        UnexpectedEnd {
            /// 1-based number of the last line.
            line: u64,
            /// What was being read.
            expected: String,
        } => "the file ends at line {line} where {expected} was expected",
        /// Binary or packed data that cannot be what they should.
        DamagedData {
            /// What is wrong.
            problem: String,
        } => "{problem}",
        /// Something else stands where a number should.
        InvalidNumber {
            /// 1-based line.
            line: u64,
            /// What stands there (shortened).
            text: String,
        } => "line {line}: `{text}` is not a number",
        /// The header or a keyword is malformed.
        InvalidSyntax {
            /// 1-based line.
            line: u64,
            /// What is wrong.
            problem: String,
        } => "line {line}: {problem}",
        /// The file holds no vertices or no faces.
        MissingElement {
            /// Which element.
            element: String,
        } => "the file has no {element}",
        /// A face names a vertex that does not exist.
        FaceIndexOutOfBounds {
            /// 0-based face.
            face: u64,
            /// The index as written.
            index: i64,
            /// Number of vertices.
            vertices: u64,
        } => "face {face} names vertex {index}, but there are {vertices} vertices",
        /// The column asked for is not there.
        UnknownColumn {
            /// Its name or number.
            column: String,
        } => "there is no column `{column}`",
        /// Several columns hold numbers, and none was asked for.
        AmbiguousColumn {
            /// Their names.
            columns: NameList,
        } => "several columns hold numbers: {columns}; name one with the option `column`",
        /// A field has not one value per vertex.
        WrongRowCount {
            /// Vertices of the mesh.
            expected: u64,
            /// Values that there are.
            actual: u64,
            /// What may have happened.
            cause: String,
        } => "there are {actual} values for the {expected} vertices of the mesh: {cause}",
        /// More vertices or faces than a 32-bit id can name.
        TooLarge {
            /// Which element.
            element: String,
            /// How many.
            count: u64,
        } => "{count} {element} are more than 32-bit ids can name",
        /// The memory that the content needs cannot be had.
        OutOfMemory {
            /// Bytes needed.
            bytes: u64,
        } => "{bytes} bytes of memory are needed, more than can be had here",
        /// A field or array has not one value per vertex (or is no multiple of what it should be).
        LengthMismatch {
            /// The field's name, or `positions` or `triangles`.
            field: String,
            /// Length that fits.
            expected: u64,
            /// Length that came.
            actual: u64,
        } => "`{field}` needs {expected} values, but there are {actual}",
        /// The format has no place for fields, which would be lost.
        FieldsNotSupported {
            /// The format's name.
            format: String,
        } => "`{format}` files cannot hold fields; write PLY, VTK or VTP, or no fields",
        /// The format has no binary variety that can be written.
        BinaryNotSupported {
            /// The format's name.
            format: String,
        } => "`{format}` files are written as text only",
        /// A coordinate to write is NaN or infinite.
        NonFinitePosition {
            /// The vertex.
            vertex: u32,
        } => "vertex {vertex} has a coordinate that is not finite",
        /// A value to write is NaN or infinite.
        NonFiniteValue {
            /// The field.
            field: String,
            /// The vertex.
            vertex: u32,
        } => "the value of `{field}` at vertex {vertex} is not finite",
    }
}
