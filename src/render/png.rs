//! Pixels as a PNG file.

use tiny_skia::PixmapMut;

use crate::error::FieldError;

/// Pixels of a picture, row by row; nothing shines through any of them.
pub(super) struct Picture {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) bytes: Vec<u8>,
}

impl Picture {
    /// All of one color.
    pub(super) fn new(width: u32, height: u32, color: [u8; 3]) -> Result<Self, FieldError> {
        let count = 4 * width as usize * height as usize;
        let mut bytes = Vec::new();
        if bytes.try_reserve_exact(count).is_err() {
            return Err(FieldError::OutOfMemory { bytes: count as u64 });
        }
        let pixel = [color[0], color[1], color[2], 255];
        bytes.resize(count, 255);
        bytes.as_chunks_mut::<4>().0.fill(pixel);
        Ok(Self { width, height, bytes })
    }

    /// To draw into. Nothing only where the size does not fit the bytes, which it does.
    pub(super) fn pixmap(&mut self) -> Option<PixmapMut<'_>> {
        PixmapMut::from_bytes(&mut self.bytes, self.width, self.height)
    }

    /// Red, green and blue, eight bits each. Row by row, so that there is no second copy of the pixels.
    pub(super) fn to_png(&self) -> Result<Vec<u8>, FieldError> {
        let mut file = Vec::new();
        let out_of_memory = || FieldError::OutOfMemory { bytes: self.bytes.len() as u64 };
        let mut encoder = png::Encoder::new(&mut file, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Balanced);
        // Writing into memory fails for no other reason.
        let mut writer = encoder.write_header().map_err(|_| out_of_memory())?;
        let mut stream = writer.stream_writer().map_err(|_| out_of_memory())?;
        let mut row = Vec::with_capacity(3 * self.width as usize);
        for pixels in self.bytes.chunks_exact(4 * self.width as usize) {
            row.clear();
            for pixel in pixels.as_chunks::<4>().0 {
                row.extend_from_slice(&pixel[..3]);
            }
            std::io::Write::write_all(&mut stream, &row).map_err(|_| out_of_memory())?;
        }
        stream.finish().map_err(|_| out_of_memory())?;
        writer.finish().map_err(|_| out_of_memory())?;
        Ok(file)
    }
}
