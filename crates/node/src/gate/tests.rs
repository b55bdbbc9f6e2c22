//! What a gate takes and what it does not.

use proptest::prelude::*;

use super::*;
use crate::testing::{key, roster, say};
use crate::wire::envelope::Letter;

const LIMITS: Limits = Limits {
    per_s: 100.0,
    burst: 20.0,
    age_max: Duration::from_secs(1),
    ahead_max: Duration::from_millis(10),
};

fn at(ms: u64) -> Instant {
    Instant::from_nanos(ms * 1_000_000)
}

fn gate(roster: &Arc<Roster>, own: u16) -> Gate {
    Gate::new(Arc::clone(roster), Purpose::Say, Some(RobotId(own)), LIMITS)
}

fn take(gate: &mut Gate, ms: u64, bytes: &[u8]) -> Result<Vec<u8>, Reject> {
    gate.take(at(ms), bytes).map(|envelope| envelope.payload.to_vec())
}

#[test]
fn each_reason_is_found_and_counted() {
    let (ours, other) = (roster(4), roster(5));
    let mut gate = gate(&ours, 1);
    let good = say(&ours, 2, [3, 5], at(1_000), b"a", &[]);
    assert_eq!(take(&mut gate, 1_000, &good), Ok(b"a".to_vec()));
    let mut forged = say(&ours, 2, [3, 9], at(1_000), b"a", &[]);
    let last = forged.len() - 1;
    forged[last] ^= 1;
    let cases = [
        (good[1..].to_vec(), Reject::Form),
        (say(&other, 2, [3, 6], at(1_000), b"a", &[]), Reject::Roster),
        (say(&ours, 1, [1, 1], at(1_000), b"a", &[]), Reject::Sender),
        (say(&ours, 5, [1, 1], at(1_000), b"a", &[]), Reject::Sender),
        (say(&ours, 0, [1, 1], at(1_000), b"a", &[]), Reject::Sender),
        (say(&ours, 2, [2, 99], at(1_000), b"a", &[]), Reject::Epoch),
        (good.clone(), Reject::Replay),
        (say(&ours, 2, [3, 4], at(1_000), b"a", &[]), Reject::Replay),
        (say(&ours, 2, [3, 6], at(1_011), b"a", &[]), Reject::Future),
        (forged, Reject::Signature),
    ];
    for (bytes, reject) in &cases {
        let before = gate.counts().total(*reject);
        assert_eq!(take(&mut gate, 1_000, bytes), Err(*reject));
        assert_eq!(gate.counts().total(*reject), before + 1, "{}", reject.name());
    }
    assert_eq!(take(&mut gate, 2_001, &say(&ours, 2, [3, 6], at(1_000), b"a", &[])), Err(Reject::Old));
    assert_eq!(take(&mut gate, 2_001, &say(&ours, 2, [4, 1], at(2_000), b"b", &[])), Ok(b"b".to_vec()));
}

#[test]
fn what_one_robot_sees_cannot_be_shown_to_another() {
    let ours = roster(4);
    let look = |to: u16, sequence: u64, payload: &[u8]| {
        let (purpose, sent) = (Purpose::Sensed, at(0));
        Letter { purpose, id: RobotId(to), epoch: 1, sequence, sent, payload, echoes: &[] }
            .seal(ours.hash(), &key(RobotId(0)))
            .unwrap()
    };
    let mut gate = Gate::new(Arc::clone(&ours), Purpose::Sensed, Some(RobotId(1)), LIMITS);
    assert_eq!(take(&mut gate, 0, &look(2, 5, b"theirs")), Err(Reject::Sender));
    assert_eq!(take(&mut gate, 0, &look(1, 5, b"mine")), Ok(b"mine".to_vec()));
    assert_eq!(take(&mut gate, 0, &look(1, 5, b"other")), Err(Reject::TwoFaced));
    assert!(gate.take_proofs().is_empty(), "it is the plant that said both, and no robot");
    let own = Letter {
        purpose: Purpose::Sensed,
        id: RobotId(1),
        epoch: 1,
        sequence: 6,
        sent: at(0),
        payload: b"x",
        echoes: &[],
    };
    let forged = own.seal(ours.hash(), &key(RobotId(1))).unwrap();
    assert_eq!(take(&mut gate, 0, &forged), Err(Reject::Signature), "a robot is not the plant");
    assert!(take(&mut gate, 0, &look(1, 6, b"mine")).is_ok());
}

#[test]
fn a_forged_number_does_not_lock_the_true_sender_out() {
    let ours = roster(4);
    let mut gate = gate(&ours, 1);
    let mut forged = say(&ours, 2, [u64::MAX, u64::MAX], at(0), b"x", &[]);
    let last = forged.len() - 1;
    forged[last] ^= 1;
    assert_eq!(take(&mut gate, 0, &forged), Err(Reject::Signature));
    assert!(take(&mut gate, 0, &say(&ours, 2, [1, 1], at(0), b"x", &[])).is_ok());
}

#[test]
fn a_flood_of_one_sender_costs_no_more_than_its_rate_and_leaves_others_alone() {
    let ours = roster(4);
    let mut gate = gate(&ours, 1);
    let mut taken = 0;
    for number in 1..=200 {
        let bytes = say(&ours, 2, [1, number], at(1_000), b"x", &[]);
        taken += u32::from(take(&mut gate, 1_000, &bytes).is_ok());
    }
    assert_eq!((taken, gate.counts().of(RobotId(2), Reject::Flood)), (20, 180));
    assert!(take(&mut gate, 1_000, &say(&ours, 3, [1, 1], at(1_000), b"x", &[])).is_ok());
}

#[test]
fn who_tells_one_robot_two_things_is_proved_two_faced() {
    let ours = roster(4);
    let mut gate = gate(&ours, 1);
    let [one, two] = [b"one", b"two"].map(|face| say(&ours, 2, [1, 7], at(0), face, &[]));
    assert!(take(&mut gate, 0, &one).is_ok());
    assert_eq!(take(&mut gate, 0, &two), Err(Reject::TwoFaced));
    let proofs = gate.take_proofs();
    assert_eq!(proofs.len(), 1);
    assert_eq!(proofs[0].verify(&ours), Ok(RobotId(2)));
    assert!(!gate.trusts(RobotId(2)));
    assert_eq!(take(&mut gate, 0, &say(&ours, 2, [1, 8], at(0), b"x", &[])), Err(Reject::Distrusted));
}

#[test]
fn who_tells_two_robots_two_things_is_found_by_their_echoes() {
    let ours = roster(4);
    let (mut first, mut third) = (gate(&ours, 1), gate(&ours, 3));
    assert!(take(&mut first, 0, &say(&ours, 2, [1, 7], at(0), b"one", &[])).is_ok());
    assert!(take(&mut third, 0, &say(&ours, 2, [1, 7], at(0), b"two", &[])).is_ok());
    let echoes = third.echoes(ECHOES_MAX);
    let said = say(&ours, 3, [1, 1], at(0), b"x", &echoes);
    let envelope = first.take(at(0), &said).unwrap();
    let copies = first.contradictions(at(0), &envelope);
    assert_eq!(copies.len(), 1, "robot 1 shows what it was told");
    assert_eq!(third.evidence(at(0), &copies[0]), Ok(()));
    let proof = third.take_proofs().remove(0).encode();
    assert_eq!(first.proof(at(0), &proof), Ok(RobotId(2)), "and robot 3 has both");
    assert_eq!(first.take_proofs().len(), 1);
    let mut fourth = gate(&ours, 4);
    assert_eq!(fourth.proof(at(0), &proof), Ok(RobotId(2)), "who was told nothing can see it too");
}

#[test]
fn a_false_echo_convicts_nobody() {
    let ours = roster(4);
    let (mut first, mut third) = (gate(&ours, 1), gate(&ours, 3));
    let said = say(&ours, 2, [1, 7], at(0), b"one", &[]);
    for gate in [&mut first, &mut third] {
        assert!(take(gate, 0, &said).is_ok());
    }
    let mut echo = third.echoes(1)[0];
    echo.hash[0] ^= 1;
    let lie = say(&ours, 3, [1, 1], at(0), b"x", &[echo]);
    let envelope = first.take(at(0), &lie).unwrap();
    for copy in first.contradictions(at(0), &envelope) {
        assert_eq!(third.evidence(at(0), &copy), Err(Reject::Replay));
    }
    assert!(first.trusts(RobotId(2)) && third.trusts(RobotId(2)));
}

#[test]
fn what_proves_nothing_is_no_proof() {
    let ours = roster(4);
    let faces = |one: [u64; 2], two: [u64; 2], id: u16| Proof {
        first: say(&ours, id, one, at(0), b"one", &[]),
        second: say(&ours, id, two, at(0), b"two", &[]),
    };
    let mut gate = gate(&ours, 1);
    let forged = |mut proof: Proof| {
        let last = proof.second.len() - 1;
        proof.second[last] ^= 1;
        proof
    };
    let same = Proof { second: faces([1, 1], [1, 1], 2).first, ..faces([1, 1], [1, 1], 2) };
    for wrong in [faces([1, 1], [1, 2], 2), faces([1, 1], [2, 1], 2), forged(faces([1, 1], [1, 1], 2)), same]
    {
        assert!(gate.proof(at(0), &wrong.encode()).is_err());
    }
    assert!(gate.trusts(RobotId(2)));
    assert_eq!(gate.proof(at(9_000), &faces([1, 1], [1, 1], 2).encode()), Ok(RobotId(2)));
}

proptest! {
    /// Whatever comes, in whatever order, what is taken of a sender has strictly rising numbers, and nothing comes twice.
    #[test]
    fn what_is_taken_rises(moves in prop::collection::vec((0_usize..12, 0_u64..3), 1..60)) {
        let ours = roster(4);
        let mut gate = gate(&ours, 1);
        let pool: Vec<Vec<u8>> =
            (0..12).map(|k| say(&ours, 2, [1 + k / 6, k % 6], at(0), b"x", &[])).collect();
        let (mut last, mut ms) = (None, 0);
        for (index, wait) in moves {
            ms += 10 * wait;
            if let Ok(envelope) = gate.take(at(ms), &pool[index]) {
                let number = (envelope.epoch, envelope.sequence);
                prop_assert!(last.is_none_or(|last| number > last));
                last = Some(number);
            }
        }
    }

    /// Any bytes, also good ones with some bytes changed, are taken or counted, and no state grows beyond its bound.
    #[test]
    fn any_bytes_are_taken_or_counted(changes in prop::collection::vec((0_usize..400, any::<u8>()), 0..6)) {
        let ours = roster(4);
        let mut gate = gate(&ours, 1);
        let mut bytes = say(&ours, 2, [1, 1], at(0), b"payload", &[]);
        let whole = bytes.clone();
        for (place, byte) in changes {
            let place = place % bytes.len();
            bytes[place] = byte;
        }
        let taken = gate.take(at(0), &bytes).is_ok();
        prop_assert_eq!(taken, bytes == whole);
        let _ = gate.evidence(at(0), &bytes);
        let _ = gate.proof(at(0), &bytes);
        let counted: u32 = Reject::ALL.iter().map(|reject| gate.counts().total(*reject)).sum();
        prop_assert_eq!(counted, u32::from(!taken));
    }
}

#[test]
fn a_word_can_be_taken_back_and_a_proof_cannot() {
    let ours = roster(4);
    let mut gate = gate(&ours, 1);
    gate.trust(RobotId(2), false);
    assert_eq!(take(&mut gate, 0, &say(&ours, 2, [1, 1], at(0), b"a", &[])), Err(Reject::Distrusted));
    gate.trust(RobotId(2), true);
    assert!(take(&mut gate, 0, &say(&ours, 2, [1, 1], at(0), b"a", &[])).is_ok());
    assert_eq!(take(&mut gate, 0, &say(&ours, 2, [1, 1], at(0), b"b", &[])), Err(Reject::TwoFaced));
    gate.trust(RobotId(2), true);
    assert_eq!(take(&mut gate, 0, &say(&ours, 2, [1, 2], at(0), b"c", &[])), Err(Reject::Distrusted));
}

#[test]
fn a_new_key_begins_anew_and_an_old_one_is_refused() {
    let (ours, old) = (roster(4), crate::testing::draft(4, 1, ""));
    let mut gate = gate(&ours, 1);
    for payload in [b"a", b"b"] {
        let _ = take(&mut gate, 0, &say(&ours, 2, [9, 9], at(0), payload, &[]));
    }
    assert!(take(&mut gate, 0, &say(&ours, 3, [9, 9], at(0), b"a", &[])).is_ok());
    assert!(!gate.trusts(RobotId(2)));
    let mut draft = old;
    draft.robots[1].key = crate::bytes::hex(key(RobotId(77)).verifying_key().as_bytes());
    let new = Arc::new(Roster::read(&crate::testing::sign(&draft), None).unwrap());
    gate.renew(&new);
    assert!(gate.trusts(RobotId(2)), "the proof is about the old key");
    assert_eq!(take(&mut gate, 0, &say(&ours, 3, [9, 10], at(0), b"a", &[])), Err(Reject::Roster));
    assert_eq!(take(&mut gate, 0, &say(&new, 2, [1, 1], at(0), b"a", &[])), Err(Reject::Signature));
    let letter = Letter {
        purpose: Purpose::Say,
        id: RobotId(2),
        epoch: 1,
        sequence: 1,
        sent: at(0),
        payload: b"a",
        echoes: &[],
    };
    let sealed = letter.seal(new.hash(), &key(RobotId(77))).unwrap();
    assert!(take(&mut gate, 0, &sealed).is_ok());
    assert_eq!(take(&mut gate, 0, &say(&new, 3, [9, 8], at(0), b"a", &[])), Err(Reject::Replay));
    assert!(take(&mut gate, 0, &say(&new, 3, [9, 10], at(0), b"a", &[])).is_ok());
}
