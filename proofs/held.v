(* Held links, the geometry (thm:held).

   In words. All robots move by their rows: robot i has for each robot j of which its row is active

     (held)  r.v + |v|^2 <= gamma (R^2 - D)^+ / 4        r = x_i - x_j, D = |r|^2, v its move of the tick.

   If i counts on j at a tick and they are within R, then they are within R at the end of the tick and at every moment
   in it, whatever part of its move each robot has done by then. So they stay within R for as long as i counts on
   j, and a robot that never releases below `need` never has fewer than `need` neighbours. With held_protocol.v this holds
   whatever is lost, late, doubled, reordered or told by others, between any two robots that keep to protocol and rows.

   A run is a sequence of ticks. Between two ticks the protocol makes any number of steps. At a tick every robot moves. *)

From Coq Require Import Reals Lra Psatz.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import vectors held_protocol.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

(* The right-hand side of the row. *)
Definition budget (gamma rad D : R) := gamma * Rmax (rad * rad - D) 0 / 4.
Definition held_row d (gamma rad : R) (r v : vec d) := dot r v + sq v <= budget gamma rad (sq r).

Section Pair.
Variables (d : nat) (gamma rad : R).
Hypothesis gamma01 : 0 < gamma <= 1.

Lemma budget_nonneg D : 0 <= budget gamma rad D.
Proof. by rewrite /budget; have := Rmax_r (rad * rad - D) 0; nra. Qed.

(* A row that a move meets is met by every part of it. *)
Lemma part_of_move (r v : vec d) t : 0 <= t <= 1 -> held_row gamma rad r v -> held_row gamma rad r (times t v).
Proof.
move=> t01; rewrite /held_row dot_times_r sq_times; have := budget_nonneg (sq r).
have := sq_nonneg v; move: (sq v) (dot r v) (budget _ _ _) => a b c a0 c0 row.
have : 0 <= t * (1 - t) * a by apply: Rmult_le_pos; [nra | lra].
nra.
Qed.

(* The two ends of a link, each with its row. *)
Lemma held_pair (r v w : vec d) : sq r <= rad * rad ->
  held_row gamma rad r v -> held_row gamma rad (times (-1) r) w -> sq (moved r v w) <= rad * rad.
Proof.
move=> inside; rewrite /held_row /budget sq_times dot_times.
have -> : -1 * -1 * sq r = sq r by lra.
rewrite Rmax_left; last by lra.
move=> row_v row_w; rewrite sq_moved; have := sq_minus_le v w; nra.
Qed.

(* thm:held for one pair and one tick, with any parts t and u of the two moves *)
Theorem held_tick (r v w : vec d) t u : 0 <= t <= 1 -> 0 <= u <= 1 -> sq r <= rad * rad ->
  held_row gamma rad r v -> held_row gamma rad (times (-1) r) w ->
  sq (moved r (times t v) (times u w)) <= rad * rad.
Proof. by move=> t01 u01 inside rv rw; apply: held_pair => //; exact: part_of_move. Qed.
End Pair.

Section Team.
Variables (V : finType) (A : {set V}) (d : nat) (gamma rad : R).
Hypothesis gamma01 : 0 < gamma <= 1.

Definition offset (x : V -> vec d) i j : vec d := minus (x i) (x j).

(* Steps of the protocol: any number. *)
Inductive steps (s : state V) : state V -> Prop :=
| NoStep : steps s s
| OneMore s' s'' : steps s s' -> step A s' s'' -> steps s s''.

Lemma steps_reachable s s' : reachable A s -> steps s s' -> reachable A s'.
Proof. by move=> re; elim=> // {}s' s'' _ re' st; exact: Step re' st. Qed.

(* Protocol states and positions at ticks 0, 1, 2, ..., and the moves. *)
Variables (s : nat -> state V) (x : nat -> V -> vec d) (v : nat -> V -> vec d).
Hypothesis begins : reachable A (s 0%N).
Hypothesis goes_on : forall p, steps (s p) (s p.+1).
Hypothesis moves : forall p i c, x p.+1 i c = x p i c + v p i c.
(* Normal robots obey their active rows. *)
Hypothesis obey : forall p i j, i \notin A -> i != j -> active (holds (s p) i j) ->
  held_row gamma rad (offset (x p) i j) (v p i).

Definition counts_on p i j := counts (holds (s p) i j).
Definition linked p i j := sq (offset (x p) i j) <= rad * rad.

Lemma reachable_at p : reachable A (s p).
Proof. by elim: p => // p IH; exact: steps_reachable IH (goes_on p). Qed.

(* Where a robot is when it has done the part t of its move. *)
Definition on_the_way p (t : V -> R) i : vec d := plus (x p i) (times (t i) (v p i)).

(* thm:held, between ticks *)
Theorem held_between p i j t : i \notin A -> j \notin A -> i != j -> (forall k, 0 <= t k <= 1) ->
  counts_on p i j -> linked p i j -> sq (offset (on_the_way p t) i j) <= rad * rad.
Proof.
move=> iA jA ij t01 co li; have [ai aj] := counted_is_held (reachable_at p) iA jA co.
have ri := obey iA ij ai; have rj : held_row gamma rad (times (-1) (offset (x p) i j)) (v p j).
  have := obey jA _ aj; rewrite eq_sym => /(_ ij); rewrite /held_row /sq /budget.
  have E : offset (x p) j i =1 times (-1) (offset (x p) i j) by move=> c; rewrite /offset /times /minus; lra.
  by rewrite !(dot_ext E E) (dot_ext E (frefl _)).
have := held_tick gamma01 (t01 i) (t01 j) li ri rj.
rewrite /sq (dot_ext (u' := offset (on_the_way p t) i j) (v' := offset (on_the_way p t) i j)) //;
  by move=> c; rewrite /moved /offset /on_the_way /plus /minus /times; lra.
Qed.

(* thm:held, at the next tick *)
Theorem held_next p i j : i \notin A -> j \notin A -> i != j ->
  counts_on p i j -> linked p i j -> linked p.+1 i j.
Proof.
move=> iA jA ij co li.
have one : forall k : V, 0 <= (fun _ => 1) k <= 1 by move=> k; lra.
have := held_between iA jA ij one co li; rewrite /linked /sq.
rewrite (dot_ext (u' := offset (x p.+1) i j) (v' := offset (x p.+1) i j)) //;
  by move=> c; rewrite /offset /on_the_way /plus /minus /times !moves; lra.
Qed.

(* thm:held, for as long as i counts on j *)
Theorem held_while p q i j : i \notin A -> j \notin A -> i != j -> linked p i j ->
  (forall k, (p <= k < p + q)%N -> counts_on k i j) -> linked (p + q) i j.
Proof.
move=> iA jA ij li; elim: q => [|q IH] co; first by rewrite addn0.
rewrite addnS; apply: held_next => //; first by apply: co; rewrite leq_addr addnS ltnS /=.
by apply: IH => k /andP [pk kq]; apply: co; rewrite pk addnS (ltn_trans kq).
Qed.

(* A robot begins to count only on robots within R; then all whom it counts on are within R at every tick. *)
Definition starts_within i := forall p j, counts_on p.+1 i j -> counts_on p i j \/ linked p.+1 i j.

Theorem held_for_ever i : i \notin A -> starts_within i ->
  (forall j, counts_on 0 i j -> linked 0 i j) ->
  forall p j, j \notin A -> i != j -> counts_on p i j -> linked p i j.
Proof.
move=> iA begin0 start0; elim=> [|p IH] j jA ij co; first exact: start0.
by case: (begin0 p j co) => // co'; apply: held_next => //; exact: IH.
Qed.

(* So a robot that counts on at least `need` normal robots has at least `need` normal neighbours. *)
Definition neighbours p i := [set j | (j != i) && (j \notin A) & Rle_dec (sq (offset (x p) i j)) (rad * rad) : bool].

Theorem degree_held i need : i \notin A -> starts_within i ->
  (forall j, counts_on 0 i j -> linked 0 i j) ->
  (forall p, (need <= #|[set j | (j != i) && (j \notin A) & counts_on p i j]|)%N) ->
  forall p, (need <= #|neighbours p i|)%N.
Proof.
move=> iA begin0 start0 enough p; apply: leq_trans (enough p) _; apply/subset_leq_card/subsetP => j.
rewrite !inE => /andP [/andP [ji jA] co]; rewrite ji jA /=.
have := held_for_ever iA begin0 start0 jA _ co; rewrite eq_sym => /(_ ji).
by rewrite /linked; case: (Rle_dec _ _).
Qed.
End Team.
