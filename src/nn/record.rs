//! The record of named tensors and text, as bytes of the safetensors format, which any language can read.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Write as _;

use safetensors::{Dtype, SafeTensorError, SafeTensors, View};

use super::actor_critic::NetworkTensor;

/// The bytes before the header: its length as a little-endian `u64`.
const LENGTH: usize = 8;

/// Named tensors with named text beside them: a checkpoint or a shipped policy.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Record {
    /// Text by name (task, seed, steps …), kept in the header's `__metadata__`.
    pub metadata: BTreeMap<String, String>,
    /// Tensors of 32-bit floating-point numbers, row-major, in the order of their names.
    pub tensors: Vec<NetworkTensor>,
}

/// Why bytes are not a record, or a record cannot be written.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{0}")]
pub struct RecordError(String);

impl Record {
    /// The record as the bytes of a safetensors file. Equal records give equal bytes.
    ///
    /// # Errors
    /// If a tensor's shape does not count its values, two tensors have one name, or one is called `__metadata__`.
    pub fn to_bytes(&self) -> Result<Vec<u8>, RecordError> {
        let mut names = std::collections::BTreeSet::new();
        for tensor in &self.tensors {
            if tensor.shape.iter().try_fold(1, |n: usize, &size| n.checked_mul(size)) != Some(tensor.values.len()) {
                return Err(RecordError(format!(
                    "tensor `{}` of shape {:?} has {} values",
                    tensor.name,
                    tensor.shape,
                    tensor.values.len()
                )));
            }
            if !names.insert(&tensor.name) || tensor.name == "__metadata__" {
                return Err(RecordError(format!("the tensor name `{}` is taken", tensor.name)));
            }
        }
        let plain = safetensors::serialize(self.tensors.iter().map(|tensor| (&tensor.name, Little(tensor))), None)
            .map_err(|error| RecordError(sentence(&error)))?;
        Ok(with_metadata(&plain, &self.metadata))
    }

    /// The record that the bytes of a safetensors file hold.
    ///
    /// # Errors
    /// If they are not of this format, or a tensor holds other numbers than `F32`.
    pub fn from_bytes(bytes: &[u8]) -> Result<Record, RecordError> {
        let (_, header) = SafeTensors::read_metadata(bytes).map_err(|error| RecordError(sentence(&error)))?;
        let file = SafeTensors::deserialize(bytes).map_err(|error| RecordError(sentence(&error)))?;
        let mut tensors = Vec::new();
        for (name, view) in file.tensors() {
            if view.dtype() != Dtype::F32 {
                return Err(RecordError(format!("tensor `{name}` holds {:?}; only F32 is read", view.dtype())));
            }
            let (numbers, _) = view.data().as_chunks::<4>();
            let values = numbers.iter().map(|&number| f32::from_le_bytes(number)).collect();
            tensors.push(NetworkTensor { name, shape: view.shape().to_vec(), values });
        }
        tensors.sort_by(|a, b| a.name.cmp(&b.name));
        let metadata = header.metadata().iter().flatten().map(|(key, text)| (key.clone(), text.clone())).collect();
        Ok(Record { metadata, tensors })
    }

    /// The tensors whose name begins with `prefix`, without it: of `module.3.actor.0.weight` and `module.3.` the tensor
    /// `actor.0.weight`.
    pub fn within(&self, prefix: &str) -> Vec<NetworkTensor> {
        let inside = |tensor: &NetworkTensor| {
            let name = tensor.name.strip_prefix(prefix)?.to_string();
            Some(NetworkTensor { name, ..tensor.clone() })
        };
        self.tensors.iter().filter_map(inside).collect()
    }
}

/// A tensor as safetensors sees it: little-endian bytes.
struct Little<'a>(&'a NetworkTensor);

impl View for Little<'_> {
    fn dtype(&self) -> Dtype {
        Dtype::F32
    }
    fn shape(&self) -> &[usize] {
        &self.0.shape
    }
    fn data(&self) -> Cow<'_, [u8]> {
        self.0.values.iter().flat_map(|value| value.to_le_bytes()).collect()
    }
    fn data_len(&self) -> usize {
        4 * self.0.values.len()
    }
}

/// The file with `metadata` in its header. safetensors would write the metadata in the order of a hash map, which differs from
/// process to process; here it stands sorted.
fn with_metadata(plain: &[u8], metadata: &BTreeMap<String, String>) -> Vec<u8> {
    if metadata.is_empty() {
        return plain.to_vec();
    }
    let (length, rest) = plain.split_first_chunk::<LENGTH>().expect("safetensors writes the length of its header first");
    let length = usize::try_from(u64::from_le_bytes(*length)).expect("the header is in memory");
    let (header, values) = rest.split_at(length);
    let header = std::str::from_utf8(header).expect("safetensors writes its header as JSON").trim_end();
    let tensors = header.strip_prefix('{').expect("a header is a JSON object");
    let entries: Vec<String> = metadata.iter().map(|(key, text)| format!("{}:{}", json(key), json(text))).collect();
    let comma = if tensors == "}" { "" } else { "," };
    let mut header = format!("{{\"__metadata__\":{{{}}}{comma}{tensors}", entries.join(","));
    header.push_str(&" ".repeat(header.len().next_multiple_of(8) - header.len()));
    [&(header.len() as u64).to_le_bytes(), header.as_bytes(), values].concat()
}

/// A JSON string ([RFC 8259](https://www.rfc-editor.org/rfc/rfc8259#section-7), section 7).
fn json(text: &str) -> String {
    let mut quoted = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            '\n' => quoted.push_str("\\n"),
            '\t' => quoted.push_str("\\t"),
            c if c < ' ' => write!(quoted, "\\u{:04x}", u32::from(c)).expect("writing to a string cannot fail"),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// What went wrong with a file, in words for a user.
fn sentence(error: &SafeTensorError) -> String {
    format!("not a readable safetensors record: {error}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn tensor(name: &str, shape: &[usize]) -> NetworkTensor {
        let count = shape.iter().product::<usize>();
        let values = (0..count).map(|i| (i as f32 - 2.5) * 0.1).collect();
        NetworkTensor { name: name.to_string(), shape: shape.to_vec(), values }
    }

    #[test]
    fn a_record_reads_back_and_equal_records_are_equal_bytes() {
        let metadata = ["task", "seed", "b", "a"].map(|key| (key.to_string(), format!("\"{key}\"\n\t\\ ○□\u{1}")));
        let record = Record {
            metadata: metadata.into(),
            tensors: vec![tensor("a.weight", &[2, 3]), tensor("b.bias", &[3]), tensor("empty", &[0, 4])],
        };
        let bytes = record.to_bytes().unwrap();
        assert_eq!(Record::from_bytes(&bytes).unwrap(), record);
        assert_eq!(Record::from_bytes(&bytes).unwrap().to_bytes().unwrap(), bytes);
        assert_eq!(record.within("a."), vec![tensor("weight", &[2, 3])]);
        let text_only = Record { tensors: Vec::new(), ..record };
        assert_eq!(Record::from_bytes(&text_only.to_bytes().unwrap()).unwrap(), text_only);
    }

    #[test]
    fn the_header_is_json_aligned_to_eight_bytes() {
        let record = Record { metadata: [("k".into(), "v".into())].into(), tensors: vec![tensor("x", &[1])] };
        let bytes = record.to_bytes().unwrap();
        let length = u64::from_le_bytes(bytes[..8].try_into().unwrap()) as usize;
        let header: serde_json::Value = serde_json::from_slice(&bytes[8..8 + length]).unwrap();
        assert_eq!(length % 8, 0);
        assert_eq!(header["__metadata__"]["k"], "v");
        assert_eq!(header["x"]["dtype"], "F32");
    }

    #[test]
    fn what_is_no_record_is_refused() {
        assert!(Record::from_bytes(b"").is_err());
        assert!(Record::from_bytes(b"{\"a\": 1}        ").is_err());
        let mut wrong = tensor("x", &[2]);
        wrong.values.pop();
        let error = Record { tensors: vec![wrong], ..Record::default() }.to_bytes().unwrap_err();
        assert_eq!(error.to_string(), "tensor `x` of shape [2] has 1 values");
        let twice = Record { tensors: vec![tensor("x", &[1]), tensor("x", &[1])], ..Record::default() };
        assert!(twice.to_bytes().is_err());
        let mut cut = Record { tensors: vec![tensor("x", &[2])], ..Record::default() }.to_bytes().unwrap();
        cut.pop();
        assert!(Record::from_bytes(&cut).is_err());
    }

    proptest! {
        #[test]
        fn any_text_and_any_bits_survive(key in ".*", text in ".*", bits in prop::collection::vec(any::<u32>(), 0..20)) {
            let values: Vec<f32> = bits.iter().map(|&bits| f32::from_bits(bits)).collect();
            let tensors = vec![NetworkTensor { name: "x".into(), shape: vec![values.len()], values }];
            let record = Record { metadata: [(key, text)].into(), tensors };
            let back = Record::from_bytes(&record.to_bytes().unwrap()).unwrap();
            prop_assert_eq!(&back.metadata, &record.metadata);
            let read: Vec<u32> = back.tensors[0].values.iter().map(|value| value.to_bits()).collect();
            prop_assert_eq!(read, bits);
        }

        #[test]
        fn no_bytes_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            let _ = Record::from_bytes(&bytes);
        }
    }
}
