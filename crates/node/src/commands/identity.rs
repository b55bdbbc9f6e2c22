//! `roster`, `key` and `verify-proof`.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Subcommand;

use crate::bytes::hex;
use crate::commands::Failure;
use crate::identity::keys;
use crate::identity::parameters;
use crate::identity::roster::{Draft, Entry, Roster, text_of};
use crate::wire::proof::{PROOF_MAX, Proof};

/// The file of the roster in its folder, and that of the operator's key.
const ROSTER: &str = "roster.toml";
const OPERATOR: &str = "operator.key";
const PLANT: &str = "plant";

/// What can be done with a roster.
#[derive(Debug, Subcommand)]
pub enum RosterCommand {
    /// Makes the operator's key and an empty roster with the settings of a scenario
    New {
        /// Folder for both; it is made if it is not there
        dir: PathBuf,
        /// File of a scenario whose tables team, link, controller, links, clock and consensus become the settings
        #[arg(long)]
        parameters: PathBuf,
        /// Name of the team
        #[arg(long, default_value = "team")]
        name: String,
    },
    /// Adds the next robot, or with the name `plant` the key of a simulated plant
    Add {
        /// Folder of the roster
        dir: PathBuf,
        /// Name of the robot: a-z, 0-9 and _
        name: String,
        /// Its public key, if it was made on the robot; otherwise a private key is made here
        #[arg(long)]
        key: Option<String>,
    },
    /// Checks the roster and signs it
    Sign {
        /// Folder of the roster
        dir: PathBuf,
    },
    /// Shows a roster and whether its signature fits
    Show {
        /// File of the roster
        file: PathBuf,
    },
}

/// Does it; what is to be printed comes back.
pub fn roster(command: &RosterCommand) -> Result<String, Failure> {
    match command {
        RosterCommand::New { dir, parameters, name } => new(dir, parameters, name),
        RosterCommand::Add { dir, name, key } => add(dir, name, key.as_deref()),
        RosterCommand::Sign { dir } => sign(dir),
        RosterCommand::Show { file } => show(file),
    }
}

fn new(dir: &Path, from: &Path, name: &str) -> Result<String, Failure> {
    let scenario = text_of(from)?;
    let parameters =
        parameters::extract(&scenario).map_err(|error| format!("{}: {error}", from.display()))?;
    let (path, key) = (dir.join(ROSTER), dir.join(OPERATOR));
    fs::create_dir_all(dir).map_err(|error| format!("{}: {error}", dir.display()))?;
    if path.exists() {
        return Err(format!("{} is there already; it is not replaced", path.display()).into());
    }
    let operator = keys::create(&key)?;
    let draft = Draft { name: name.into(), parameters, plant: None, robots: Vec::new() };
    write(&path, &draft.write()?)?;
    let public = hex(operator.verifying_key().as_bytes());
    Ok(format!(
        "operator {public}\n{} keeps the private key: whoever has it decides who is in the team",
        key.display()
    ))
}

fn add(dir: &Path, name: &str, key: Option<&str>) -> Result<String, Failure> {
    let path = dir.join(ROSTER);
    let mut draft = Draft::read(&text_of(&path)?)?;
    let id = u16::try_from(draft.robots.len() + 1)?;
    if draft.robots.iter().any(|entry| entry.name == name) {
        return Err(format!("`{name}` is in {} already", path.display()).into());
    }
    let (public, file) = if let Some(key) = key {
        keys::public(key).ok_or("--key must be a public key of 64 hexadecimal digits")?;
        (key.to_lowercase(), None)
    } else {
        let file = dir.join(format!("{name}.key"));
        (hex(keys::create(&file)?.verifying_key().as_bytes()), Some(file))
    };
    let what = if name == PLANT {
        draft.plant = Some(public.clone());
        "the plant".to_owned()
    } else {
        draft.robots.push(Entry { id, name: name.into(), key: public.clone() });
        format!("robot {id}, {name}")
    };
    write(&path, &draft.write()?)?;
    let kept = file.map(|file| {
        format!("\n{} is its private key: bring it to the robot and delete it here", file.display())
    });
    Ok(format!(
        "{what}: {public}{}\nnow sign: closeranks-node roster sign {}",
        kept.unwrap_or_default(),
        dir.display()
    ))
}

fn sign(dir: &Path) -> Result<String, Failure> {
    let path = dir.join(ROSTER);
    let draft = Draft::read(&text_of(&path)?)?;
    let operator = keys::load(&dir.join(OPERATOR))?;
    let text = draft.sign(&operator)?;
    write(&path, &text)?;
    let roster = Roster::read(&text, Some(&operator.verifying_key()))?;
    Ok(format!(
        "{} is signed: {} robots, hash {}",
        path.display(),
        roster.robots().len(),
        hex(&roster.hash()[..8])
    ))
}

fn show(file: &Path) -> Result<String, Failure> {
    let text = text_of(file)?;
    let draft = Draft::read(&text)?;
    let mut lines = vec![format!("team      {}", draft.name)];
    match Roster::read(&text, None) {
        Ok(roster) => {
            lines.push(format!("operator  {}", hex(roster.operator().as_bytes())));
            lines.push(format!("hash      {}", hex(roster.hash())));
            lines.push("signature fits".into());
        }
        Err(error) => lines.push(format!("NOT GOOD: {error}")),
    }
    lines.extend(draft.plant.iter().map(|key| format!("plant     {key}")));
    lines.extend(
        draft.robots.iter().map(|robot| format!("robot {:>3} {:<16} {}", robot.id, robot.name, robot.key)),
    );
    lines.push(format!("settings\n{}", draft.parameters.trim_end()));
    Ok(lines.join("\n"))
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    let beside = path.with_extension("toml-new");
    fs::write(&beside, text)
        .and_then(|()| fs::rename(&beside, path))
        .map_err(|error| format!("{}: {error}", path.display()).into())
}

/// Makes a private key in a new file and gives the public one.
pub fn key(file: &Path) -> Result<String, Failure> {
    Ok(hex(keys::create(file)?.verifying_key().as_bytes()))
}

/// Says who is proved two-faced by the proof in a file.
pub fn verify_proof(file: &Path, roster: &Path) -> Result<String, Failure> {
    let named = |error: &dyn core::fmt::Display| format!("{}: {error}", file.display());
    if fs::metadata(file).map_err(|error| named(&error))?.len() > u64::try_from(PROOF_MAX)? {
        return Err(named(&format!("has more than {PROOF_MAX} bytes, so it is no proof")).into());
    }
    let roster = Roster::load(roster, None)?;
    let proof =
        Proof::parse(&fs::read(file).map_err(|error| named(&error))?).map_err(|error| named(&error))?;
    let id = proof.verify(&roster).map_err(|error| named(&error))?;
    let name = roster.robots().get(usize::from(id.0) - 1).map_or("", |entry| entry.name.as_str());
    Ok(format!("robot {} ({name}) signed two different messages with one number: it is two-faced", id.0))
}

#[cfg(test)]
mod tests {
    use closeranks_core::{Instant, RobotId};

    use super::*;
    use crate::testing::{draft, roster, say, sign};

    #[test]
    fn a_proof_in_a_file_names_the_robot_and_anything_else_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let (file, path) = (folder.path().join("robot-2.proof"), folder.path().join("roster.toml"));
        fs::write(&path, sign(&draft(4, 1, ""))).unwrap();
        let ours = roster(4);
        let face = |payload: &[u8], number: u64| say(&ours, 2, [1, number], Instant::START, payload, &[]);
        let check = |first: Vec<u8>, second: Vec<u8>| {
            fs::write(&file, Proof { first, second }.encode()).unwrap();
            verify_proof(&file, &path).map_err(|error| error.to_string())
        };
        let said = check(face(b"a", 7), face(b"b", 7)).unwrap();
        assert_eq!(
            said,
            format!(
                "robot {} (robot_2) signed two different messages with one number: it is two-faced",
                RobotId(2).0
            )
        );
        assert!(check(face(b"a", 7), face(b"a", 7)).unwrap_err().contains("both envelopes are the same"));
        assert!(check(face(b"a", 7), face(b"b", 8)).unwrap_err().contains("an honest robot may send both"));
        let mut forged = face(b"b", 7);
        *forged.last_mut().unwrap() ^= 1;
        assert!(check(face(b"a", 7), forged).unwrap_err().contains("robot 2 did not sign both"));
        fs::write(&file, vec![0; PROOF_MAX + 1]).unwrap();
        assert!(verify_proof(&file, &path).unwrap_err().to_string().contains("so it is no proof"));
    }
}
