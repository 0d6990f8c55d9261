//! Messages filled from a counter, as `tests/golden/write_cdr.py` fills them.

use std::fmt;

use apprentice_msgs::Message;
use serde::de::{self, DeserializeSeed, Deserializer, SeqAccess, Visitor};

/// The message whose members, in order, are 1, 2, 3 …; sequences have one element, octets three.
pub fn filled<M: Message>() -> M {
    M::deserialize(&mut Filler { counter: 0 }).expect("the filler has a value for every member")
}

struct Filler {
    counter: u8,
}

impl Filler {
    fn next(&mut self) -> u8 {
        self.counter += 1;
        self.counter
    }
}

#[derive(Debug)]
struct NoValue(String);

impl fmt::Display for NoValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for NoValue {}

impl de::Error for NoValue {
    fn custom<T: fmt::Display>(message: T) -> NoValue {
        NoValue(message.to_string())
    }
}

macro_rules! from_counter {
    ($($method:ident => $visit:ident),*) => {
        $(fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, NoValue> {
            visitor.$visit((self.next() % 100).into())
        })*
    };
}

impl<'de> Deserializer<'de> for &mut Filler {
    type Error = NoValue;

    from_counter!(
        deserialize_i8 => visit_i64, deserialize_i16 => visit_i16, deserialize_i32 => visit_i32,
        deserialize_i64 => visit_i64, deserialize_u8 => visit_u8, deserialize_u16 => visit_u16,
        deserialize_u32 => visit_u32, deserialize_u64 => visit_u64
    );

    fn deserialize_any<V: Visitor<'de>>(self, _visitor: V) -> Result<V::Value, NoValue> {
        Err(de::Error::custom("a member of unknown type"))
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, NoValue> {
        visitor.visit_bool(self.next() % 2 == 1)
    }

    fn deserialize_f32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, NoValue> {
        visitor.visit_f32(f32::from(self.next()) + 0.5)
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, NoValue> {
        visitor.visit_f64(f64::from(self.next()) + 0.5)
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, NoValue> {
        visitor.visit_string(format!("s{}", self.next()))
    }

    fn deserialize_byte_buf<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, NoValue> {
        let octets = [self.next(), self.next(), self.next()];
        visitor.visit_byte_buf(octets.to_vec())
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, NoValue> {
        self.deserialize_tuple(1, visitor)
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, NoValue> {
        visitor.visit_seq(Elements { filler: self, left: length })
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, NoValue> {
        self.deserialize_tuple(fields.len(), visitor)
    }

    serde::forward_to_deserialize_any! {
        i128 u128 char str bytes option unit unit_struct newtype_struct tuple_struct map enum
        identifier ignored_any
    }
}

struct Elements<'a> {
    filler: &'a mut Filler,
    left: usize,
}

impl<'de> SeqAccess<'de> for Elements<'_> {
    type Error = NoValue;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, NoValue> {
        if self.left == 0 {
            return Ok(None);
        }
        self.left -= 1;
        seed.deserialize(&mut *self.filler).map(Some)
    }
}
