(* Rules that differ a little and are unsound.

   In words. (1) Held links, a row that is dropped as soon as one has stopped listing: somebody may still count on it. (2) Held links
   without lives, that is, a row that is dropped when the newest message does not list, whether or not its sender knows the
   present life: a message of long ago drops a row on which somebody counts (docs/theory/links.md, "Why a life matters"). *)

From Coq Require Import Reals Lra.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import held_protocol.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Section Links.
(* Two robots, i = true and j = false, both normal. *)
Let A : {set bool_finType} := set0.
Let i : bool_finType := true.
Let j : bool_finType := false.

Definition lists_ (s : state bool_finType) i j :=
  State (last s) (set2 i j (list_from (last s i) (holds s i j)) (holds s)) (@sent bool_finType s).
Definition sends_ (s : state bool_finType) i n := State (set1 i n (last s)) (holds s)
  (add i (Message n (fun j => entry_of (holds s i j))) (@sent bool_finType s)).
Definition hears_ (s : state bool_finType) i j m :=
  State (last s) (set2 i j (hear (last s i) (word_to i m) (holds s i j)) (holds s)) (@sent bool_finType s).
Definition forgets_ (s : state bool_finType) i j :=
  State (last s) (set2 i j (fresh (last s i)) (holds s)) (@sent bool_finType s).
Definition said (s : state bool_finType) i n := Message n (fun j => entry_of (@holds bool_finType s i j)).

(* i lists j and says so; j hears it and answers; i hears that. j never lists i. *)
Let s1 := lists_ (start bool_finType) i j.
Let s2 := sends_ s1 i 1.
Let s3 := hears_ s2 j i (said s1 i 1).
Let s4 := sends_ s3 j 1.
Let s5 := hears_ s4 i j (said s3 j 1).

Lemma reach5 : reachable A s5.
Proof.
have r1 : reachable A s1 by apply: (Step (Start A)); apply: Lists.
have r2 : reachable A s2 by apply: (Step r1); apply: Sends.
have r3 : reachable A s3 by apply: (Step r2); apply: Hears; right.
have r4 : reachable A s4 by apply: (Step r3); apply: Sends.
by apply: (Step r4); apply: Hears; right.
Qed.

Theorem row_dropped_on_release : exists s i j,
  [/\ reachable A s, counts (holds s i j) & ~~ lists (holds s j i)].
Proof. by exists s5, i, j; split=> //; exact: reach5. Qed.

(* First a message that does not list j, which is late; then as above; then j forgets, and the late message arrives. *)
Let t0 := sends_ (start bool_finType) i 1.
Let t1 := lists_ t0 i j.
Let t2 := sends_ t1 i 2.
Let t3 := hears_ t2 j i (said t1 i 2).
Let t4 := sends_ t3 j 1.
Let t5 := hears_ t4 i j (said t3 j 1).
Let t6 := forgets_ t5 j i.
Let t7 := hears_ t6 j i (said (start bool_finType) i 1).

Definition released_without_lives (h : hold) :=
  if heard h is Some w then ~~ listed (of_entry w) else false.

Lemma reach7 : reachable A t7.
Proof.
have r0 : reachable A t0 by apply: (Step (Start A)); apply: Sends.
have r1 : reachable A t1 by apply: (Step r0); apply: Lists.
have r2 : reachable A t2 by apply: (Step r1); apply: Sends.
have r3 : reachable A t3 by apply: (Step r2); apply: Hears; right.
have r4 : reachable A t4 by apply: (Step r3); apply: Sends.
have r5 : reachable A t5 by apply: (Step r4); apply: Hears; right.
have r6 : reachable A t6 by apply: (Step r5); apply: Forgets.
by apply: (Step r6); apply: Hears; left; left; right.
Qed.

Theorem without_lives : exists s i j,
  [/\ reachable A s, counts (holds s i j), ~~ lists (holds s j i) & released_without_lives (holds s j i)].
Proof. by exists t7, i, j; split=> //; exact: reach7. Qed.
End Links.
