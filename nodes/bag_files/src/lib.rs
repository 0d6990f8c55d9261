//! Bag folders on the file system: open, create, recover and describe them.
