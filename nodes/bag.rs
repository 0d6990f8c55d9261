//! `apprentice bag`: what is in a bag, and making a broken one whole.

use bag_files::{BagFilesError, BagInfo, Recovered, open_bag, recover_in_place};
use clap::{Parser, Subcommand};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Looks at recorded bags and repairs them.
#[derive(Debug, Parser)]
#[command(
    name = "apprentice bag",
    disable_help_subcommand = true,
    after_help = "Examples:\n  apprentice bag info bags/session-20260101-120000/bag\n  apprentice bag recover broken.mcap"
)]
pub struct Bag {
    #[command(subcommand)]
    command: BagCommand,
}

#[derive(Debug, Subcommand)]
enum BagCommand {
    /// Prints topics, types, counts, times, attachments, and what is damaged
    Info {
        /// A bag's folder, its metadata.yaml, or one .mcap file
        bag: PathBuf,
        /// One JSON object instead of a table
        #[arg(long)]
        json: bool,
    },
    /// Makes a bag that was cut short or damaged whole, in place; a damaged original is kept beside it
    Recover {
        /// A bag's folder, or one .mcap file
        bag: PathBuf,
    },
}

/// Runs the command. Exit code 1: `info` found damage; 2: the bag cannot be used.
pub fn run(bag: &Bag) -> ExitCode {
    let result = match &bag.command {
        BagCommand::Info { bag, json } => info(bag, *json),
        BagCommand::Recover { bag } => recover(bag),
    };
    result.unwrap_or_else(|error| {
        eprintln!("error: {error}");
        ExitCode::from(2)
    })
}

fn info(path: &Path, json: bool) -> Result<ExitCode, BagFilesError> {
    let info = BagInfo::of(&open_bag(path)?);
    if json {
        println!("{}", info.to_json());
    } else {
        print!("{info}");
    }
    Ok(if info.damage.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn recover(path: &Path) -> Result<ExitCode, BagFilesError> {
    for file in recover_in_place(path)? {
        let messages = file.contents.topics.iter().map(|topic| topic.message_count).sum::<u64>();
        let outcome = match &file.outcome {
            Recovered::Whole => "was whole already".to_owned(),
            Recovered::Finished => "is finished now, nothing was lost".to_owned(),
            Recovered::Salvaged { damage, original } => {
                format!("holds what could be read ({}); the original is {}", damage.join("; "), original.display())
            }
        };
        println!("{}: {outcome}; {messages} messages", file.path.display());
    }
    Ok(ExitCode::SUCCESS)
}
