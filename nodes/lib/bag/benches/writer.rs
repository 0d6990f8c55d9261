//! How many messages and bytes a second the bag writer takes, by message size and compression.

use std::hint::black_box;

use bag::{BagWriter, Compression, Topic, WriterOptions};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

/// Messages written in one iteration.
const MESSAGES: u64 = 1_000;

fn write_bag(compression: Compression, message: &[u8]) -> usize {
    let options = WriterOptions { compression, ..WriterOptions::default() };
    let mut writer = BagWriter::new(Vec::new(), &options).expect("a vector takes everything");
    let topic = Topic::ros2("/bench", "std_msgs/msg/UInt8MultiArray", "", &[]);
    let id = writer.add_topic(&topic).expect("a first topic fits");
    for i in 0..MESSAGES {
        writer.write(id, i, i, message).expect("a vector takes everything");
    }
    let (bytes, _) = writer.finish().expect("a vector takes everything");
    bytes.len()
}

fn writer(c: &mut Criterion) {
    for (name, compression) in [("none", Compression::None), ("lz4", Compression::Lz4)] {
        let mut group = c.benchmark_group(format!("write_{name}"));
        group.sample_size(20);
        for size in [100_usize, 4_096, 65_536] {
            let message: Vec<u8> = (0..size).map(|i| (i * 31 % 251) as u8).collect();
            group.throughput(Throughput::ElementsAndBytes { elements: MESSAGES, bytes: MESSAGES * size as u64 });
            group.bench_with_input(BenchmarkId::from_parameter(size), &message, |b, message| {
                b.iter(|| black_box(write_bag(compression, message)));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, writer);
criterion_main!(benches);
