//! Which shard an array job is: what schedulers tell their tasks in variables.

use crate::shard::Shard;

/// What a scheduler calls the number of a task, the number of tasks, and the first number where the user cannot choose it.
struct Scheduler {
    name: &'static str,
    task: &'static str,
    tasks: &'static str,
    first: First,
}

/// How tasks are numbered.
enum First {
    /// From this number.
    Is(u64),
    /// From the number in this variable, one after another up to the number in the other.
    In(&'static str, &'static str),
}

/// Schedulers that are known. A new one is a line.
const SCHEDULERS: [Scheduler; 4] = [
    Scheduler {
        name: "Slurm",
        task: "SLURM_ARRAY_TASK_ID",
        tasks: "SLURM_ARRAY_TASK_COUNT",
        first: First::In("SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX"),
    },
    Scheduler {
        name: "AWS Batch",
        task: "AWS_BATCH_JOB_ARRAY_INDEX",
        tasks: "AWS_BATCH_JOB_ARRAY_SIZE",
        first: First::Is(0),
    },
    Scheduler {
        name: "Cloud Run",
        task: "CLOUD_RUN_TASK_INDEX",
        tasks: "CLOUD_RUN_TASK_COUNT",
        first: First::Is(0),
    },
    Scheduler { name: "Kubernetes", task: "JOB_COMPLETION_INDEX", tasks: TASKS, first: First::Is(0) },
];

/// Number of tasks, for schedulers that do not tell it, or that tell how many are run again.
const TASKS: &str = "CLOSERANKS_SHARDS";

/// The shard that this task of an array is, by what `variable` says of each name.
///
/// Slurm tells how many tasks were submitted. Where some of an array are submitted again, such as 3,7, that is not the number of shards,
/// so numbers that do not go on from 0 or 1 are an error unless `CLOSERANKS_SHARDS` says how many shards there are; the first is
/// task 1 then. Kubernetes does not tell the number of completions: the job's template must say it as `CLOSERANKS_SHARDS`.
pub fn auto(variable: &dyn Fn(&str) -> Option<String>) -> Result<Shard, String> {
    let Some(scheduler) = SCHEDULERS.iter().find(|scheduler| variable(scheduler.task).is_some()) else {
        let names = SCHEDULERS.map(|scheduler| format!("{} ({})", scheduler.name, scheduler.task));
        return Err(format!("this is no task of an array: none of these is set: {}", names.join(", ")));
    };
    let given = variable(TASKS).is_some();
    let (first, count) = match scheduler.first {
        First::Is(first) => (first, scheduler.count(variable)?),
        First::In(..) if given => (1, number(variable, TASKS)?),
        First::In(least, most) => {
            let (first, count) = (number(variable, least)?, number(variable, scheduler.tasks)?);
            let last = number(variable, most)?;
            let is_dense = last.checked_sub(first).and_then(|wide| wide.checked_add(1)) == Some(count);
            if first > 1 || !is_dense {
                return Err(part(scheduler, first, last, count));
            }
            (first, count)
        }
    };
    let task = number(variable, scheduler.task)?;
    let index = task.checked_sub(first).and_then(|index| index.checked_add(1)).unwrap_or(0);
    Shard::new(index, count)
        .ok_or_else(|| format!("{} = {task} is no task of {count} from number {first} on", scheduler.task))
}

impl Scheduler {
    /// How many tasks.
    fn count(&self, variable: &dyn Fn(&str) -> Option<String>) -> Result<u64, String> {
        let name = if variable(TASKS).is_some() { TASKS } else { self.tasks };
        if variable(name).is_none() {
            return Err(format!(
                "{} is set and {name} is not: set {TASKS} to the number of tasks",
                self.task
            ));
        }
        number(variable, name)
    }
}

/// The number in a variable.
fn number(variable: &dyn Fn(&str) -> Option<String>, name: &str) -> Result<u64, String> {
    let text = variable(name).ok_or_else(|| format!("{name} is not set"))?;
    text.parse().map_err(|_| format!("{name} is `{text}`, allowed is a whole number"))
}

fn part(scheduler: &Scheduler, first: u64, last: u64, count: u64) -> String {
    let tasks = scheduler.tasks;
    format!(
        "{count} tasks with numbers from {first} to {last} are a part of an array, so {tasks} does not say how many shards there \
         are: set {TASKS} to their number, of which the first task is 1"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn auto_of(variables: &[(&str, &str)]) -> Result<String, String> {
        let of = |name: &str| {
            let found = variables.iter().find(|(known, _)| *known == name);
            found.map(|(_, value)| (*value).to_owned())
        };
        auto(&of).map(|shard| shard.to_string())
    }

    fn slurm<'a>(task: &'a str, count: &'a str, least: &'a str, most: &'a str) -> [(&'a str, &'a str); 4] {
        [
            ("SLURM_ARRAY_TASK_ID", task),
            ("SLURM_ARRAY_TASK_COUNT", count),
            ("SLURM_ARRAY_TASK_MIN", least),
            ("SLURM_ARRAY_TASK_MAX", most),
        ]
    }

    #[test]
    fn slurm_counts_from_where_the_user_began() {
        assert_eq!(auto_of(&slurm("3", "8", "1", "8")), Ok("3/8".into()));
        assert_eq!(auto_of(&slurm("0", "8", "0", "7")), Ok("1/8".into()));
        assert_eq!(auto_of(&slurm("7", "8", "0", "7")), Ok("8/8".into()));
        assert_eq!(auto_of(&slurm("1", "1", "1", "1")), Ok("1/1".into()), "an array of one task");
    }

    /// `sbatch --array=3,7` runs two tasks of what were eight: it must not become 1/2 and 2/2 in silence.
    #[test]
    fn a_part_of_a_slurm_array_must_be_told_the_number_of_shards() {
        for again in [slurm("7", "2", "3", "7"), slurm("5", "1", "5", "5"), slurm("1", "2", "1", "7")] {
            let wrong = auto_of(&again).unwrap_err();
            assert!(wrong.contains("part of an array") && wrong.contains("CLOSERANKS_SHARDS"), "{wrong}");
        }
        let told = [&slurm("7", "2", "3", "7")[..], &[("CLOSERANKS_SHARDS", "8")]].concat();
        assert_eq!(auto_of(&told), Ok("7/8".into()));
        let out = [&slurm("9", "2", "3", "9")[..], &[("CLOSERANKS_SHARDS", "8")]].concat();
        assert!(auto_of(&out).is_err());
    }

    #[test]
    fn others_count_from_zero() {
        let batch = [("AWS_BATCH_JOB_ARRAY_INDEX", "0"), ("AWS_BATCH_JOB_ARRAY_SIZE", "4")];
        assert_eq!(auto_of(&batch), Ok("1/4".into()));
        let run = [("CLOUD_RUN_TASK_INDEX", "3"), ("CLOUD_RUN_TASK_COUNT", "4")];
        assert_eq!(auto_of(&run), Ok("4/4".into()));
        let kubernetes = [("JOB_COMPLETION_INDEX", "2"), ("CLOSERANKS_SHARDS", "3")];
        assert_eq!(auto_of(&kubernetes), Ok("3/3".into()));
        let wrong = auto_of(&kubernetes[..1]).unwrap_err();
        assert!(wrong.contains("set CLOSERANKS_SHARDS to the number of tasks"), "{wrong}");
    }

    #[test]
    fn what_is_no_array_or_no_number_is_refused() {
        assert!(auto_of(&[]).unwrap_err().contains("this is no task of an array"));
        let huge = u64::MAX.to_string();
        for (task, count) in
            [("4", "4"), ("x", "4"), ("-1", "4"), ("0", "0"), (huge.as_str(), "4"), ("0", huge.as_str())]
        {
            let batch = [("AWS_BATCH_JOB_ARRAY_INDEX", task), ("AWS_BATCH_JOB_ARRAY_SIZE", count)];
            assert!(auto_of(&batch).is_err(), "{task} {count}");
        }
        assert!(auto_of(&slurm("1", "2", "0", huge.as_str())).is_err());
    }
}
