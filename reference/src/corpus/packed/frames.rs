//! Files packed by zstd, which may have several frames.

use std::io::{self, BufRead, Read};

use ruzstd::decoding::StreamingDecoder;

/// What is packed in the frames of a zstd file, one after another.
pub(super) enum Frames<R: Read> {
    Between(R),
    Within(Box<StreamingDecoder<R, ruzstd::decoding::FrameDecoder>>),
    Over,
}

impl<R: BufRead> Read for Frames<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        loop {
            *self = match std::mem::replace(self, Frames::Over) {
                Frames::Between(mut file) => match file.fill_buf()?.is_empty() {
                    true => Frames::Over,
                    false => {
                        let frame = StreamingDecoder::new(file).map_err(io::Error::other)?;
                        Frames::Within(Box::new(frame))
                    }
                },
                Frames::Within(mut frame) => match frame.read(bytes)? {
                    0 => Frames::Between(frame.into_inner()),
                    count => {
                        *self = Frames::Within(frame);
                        return Ok(count);
                    }
                },
                Frames::Over => return Ok(0),
            };
        }
    }
}
