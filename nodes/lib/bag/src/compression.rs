//! Decompressing one chunk, never to more than its header claims.

use std::io::Read;

use crate::BagError;

/// How the chunks of a new bag are compressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Compression {
    /// Not at all; what `ros2 bag record` does by default.
    #[default]
    None,
    /// LZ4: fast, about half the size on most robot data.
    Lz4,
}

/// The bytes of a chunk that was stored as `data`. `offset` is only for the error.
pub(crate) fn decompress(name: &str, data: &[u8], uncompressed_size: u64, offset: u64) -> Result<Vec<u8>, BagError> {
    let fail = |why: String| BagError::Decompression { offset, why };
    let mut bytes = Vec::new();
    // One byte more than claimed is asked for, so that a chunk which is longer is noticed but never unpacked.
    let most = uncompressed_size.saturating_add(1);
    match name {
        "" => bytes.extend_from_slice(data),
        "lz4" => {
            let decoder = lz4::Decoder::new(data).map_err(|error| fail(error.to_string()))?;
            decoder.take(most).read_to_end(&mut bytes).map_err(|error| fail(error.to_string()))?;
        }
        "zstd" => unpack_zstd(data, most, &mut bytes).map_err(fail)?,
        _ => return Err(BagError::UnknownCompression { offset, name: name.to_owned() }),
    }
    if bytes.len() as u64 != uncompressed_size {
        let got = bytes.len();
        return Err(fail(format!("it unpacks to {got} bytes or more, expected {uncompressed_size}")));
    }
    Ok(bytes)
}

/// Unpacks every frame of `data` until `most` bytes are there.
fn unpack_zstd(mut data: &[u8], most: u64, bytes: &mut Vec<u8>) -> Result<(), String> {
    while !data.is_empty() && (bytes.len() as u64) < most {
        let before = data.len();
        let decoder = ruzstd::decoding::StreamingDecoder::new(&mut data).map_err(|error| error.to_string())?;
        let left = most - bytes.len() as u64;
        decoder.take(left).read_to_end(bytes).map_err(|error| error.to_string())?;
        if data.len() == before {
            return Err("it holds an empty zstd frame".to_owned());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zstd_chunk_of_others_is_unpacked() {
        let text = b"the same the same the same the same the same".repeat(20);
        let packed = ruzstd::encoding::compress_to_vec(&text[..], ruzstd::encoding::CompressionLevel::Fastest);
        assert_eq!(decompress("zstd", &packed, text.len() as u64, 0).expect("it is valid"), text);
    }

    #[test]
    fn a_chunk_that_unpacks_to_more_than_it_claims_is_refused() {
        let zeros = vec![0_u8; 1 << 20];
        let packed = ruzstd::encoding::compress_to_vec(&zeros[..], ruzstd::encoding::CompressionLevel::Fastest);
        let error = decompress("zstd", &packed, 100, 7).expect_err("it is longer").to_string();
        assert_eq!(error, "the chunk at byte 7 does not decompress: it unpacks to 101 bytes or more, expected 100");
    }

    #[test]
    fn an_unknown_compression_is_named() {
        let error = decompress("brotli", &[], 0, 12).expect_err("nobody writes that").to_string();
        assert!(error.contains("byte 12") && error.contains("'brotli'"), "{error}");
    }
}
