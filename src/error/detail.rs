//! What errors carry.

/// A value that an error carries: an id, a number, or a name.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Detail {
    /// An id, a line, a length or a number of bytes.
    Integer(u64),
    /// A signed index as it stands in the input.
    Signed(i64),
    /// A number.
    Real(f64),
    /// A name or a piece of the input.
    Text(String),
    /// Names.
    #[cfg(feature = "files")]
    Texts(Vec<String>),
}

impl From<u32> for Detail {
    fn from(value: u32) -> Self {
        Self::Integer(u64::from(value))
    }
}
impl From<u64> for Detail {
    fn from(value: u64) -> Self {
        Self::Integer(value)
    }
}
impl From<usize> for Detail {
    fn from(value: usize) -> Self {
        Self::Integer(value as u64)
    }
}
impl From<i64> for Detail {
    fn from(value: i64) -> Self {
        Self::Signed(value)
    }
}
impl From<f64> for Detail {
    fn from(value: f64) -> Self {
        Self::Real(value)
    }
}
impl From<String> for Detail {
    fn from(value: String) -> Self {
        Self::Text(value)
    }
}
impl From<&'static str> for Detail {
    fn from(value: &'static str) -> Self {
        Self::Text(value.to_owned())
    }
}
/// Names, listed in a message with commas between them.
#[cfg(feature = "files")]
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NameList(pub Vec<String>);

#[cfg(feature = "files")]
impl core::fmt::Display for NameList {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.0.join(", "))
    }
}

#[cfg(feature = "files")]
impl From<NameList> for Detail {
    fn from(names: NameList) -> Self {
        Self::Texts(names.0)
    }
}
