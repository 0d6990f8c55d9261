//! TEMPORARY
fn main(){}
