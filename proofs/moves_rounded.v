(* What is rounded when bodies move (crates/sim/src/plant/single.rs, crates/sim/src/monitors/truth.rs: `rounding_m2`).

   In words. A coordinate x becomes x + h v in a tick, with both operations rounded. No coordinate before or after is larger than S, at most 1e9 m.

   `move_error`: the new coordinate is wrong by at most 3.002 * 2^-53 S + 3 * 2^-1075.
   `distance_after_move`: the squared distance of two robots after the tick, from their positions as they are stored, differs from that of exact moves by at most
   2.4e-15 S d + 2e-30 S^2 + 1e-270, with d the distance after exact moves, in up to three dimensions.
   `tolerance_of_places`: where d >= 3e-15 S this is at most 1e-14 S d + 1e-270. The laws allow 1e-14 S d for one tick, and 1e-11 of the squared distance, which covers what is
   rounded when it is computed (`distance_error`).

   `drift`: what the rows keep is D - Delta_d^2 >= 0, of which a tick may take the part gamma. If rounding adds at most e to that in every tick, D - Delta_d^2 >= - p e
   after p ticks, and no better bound follows: where D - Delta_d^2 is below 0 nothing of the rows brings it back. The laws measure each tick from the one before, so
   they see e and not p e. With S = 10 m and d = 0.5 m, p e is below 1.3e-9 m^2 after 100,000 ticks, for the moves alone. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Closeranks Require Import rounding exponential link_rounded slope_max_rounded.
Local Open Scope R_scope.

Section Moves.
Variables (h span : R).
Hypothesis span_range : 0 <= span <= 1e9.
Definition moved_fl x v := fl (x + fl (h * v)).
Definition moved x v := x + h * v.

Theorem move_error x v : Rabs x <= span -> Rabs (moved_fl x v) <= span -> Rabs (moved_fl x v - moved x v) <= 3.002 * u * span + 3 * eta.
Proof.
intros x0 x1; assert (U := u_value); assert (n0 := eta_pos); unfold moved_fl, moved in *; set (m := h * v) in *.
assert (M := fl_error m); assert (A : Rabs (x + fl m - (x + m)) <= u * Rabs m + eta) by (replace (_ - _) with (fl m - m) by ring; exact M).
assert (B := fl_of _ _ _ _ A (Rle_refl (Rabs (x + m)))); set (y := fl (x + fl m)) in *; set (err := Rabs (y - (x + m))) in *.
assert (s1 : Rabs (x + m) <= span + err).
  replace (x + m) with (y + - (y - (x + m))) by ring; apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_Ropp; fold err; lra.
assert (s2 : Rabs m <= 2 * span + err).
  replace m with ((x + m) + - x) by ring; apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_Ropp; lra.
assert (e0 : 0 <= err) by apply Rabs_pos; rewrite U in *; lra.
Qed.

Variables (k : nat) (x y v w : nat -> R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis before : forall c, Rabs (x c) <= span /\ Rabs (y c) <= span.
Hypothesis after : forall c, Rabs (moved_fl (x c) (v c)) <= span /\ Rabs (moved_fl (y c) (w c)) <= span.
(* Offsets after the tick: of exact moves, and of the positions that are stored. *)
Definition offset_exact c := moved (x c) (v c) - moved (y c) (w c).
Definition offset_stored c := moved_fl (x c) (v c) - moved_fl (y c) (w c).
Let D := dot offset_exact offset_exact k.
Let D' := dot offset_stored offset_stored k.
Let e := 3.002 * u * span + 3 * eta.

Lemma offset_near c : Rabs (offset_stored c - offset_exact c) <= 2 * e.
Proof.
destruct (before c) as [b1 b2]; destruct (after c) as [a1 a2]; assert (H1 := move_error _ _ b1 a1); assert (H2 := move_error _ _ b2 a2); fold e in H1, H2.
unfold offset_stored, offset_exact; set (p := moved_fl (x c) (v c)) in *; set (q := moved_fl (y c) (w c)) in *.
replace (_ - _) with ((p - moved (x c) (v c)) + - (q - moved (y c) (w c))) by ring.
apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_Ropp; lra.
Qed.

Lemma offset_small c : Rabs (offset_exact c) <= 2 * span + 2 * e.
Proof.
destruct (after c) as [a1 a2]; assert (N := offset_near c); unfold offset_stored in N.
replace (offset_exact c) with ((moved_fl (x c) (v c) + - moved_fl (y c) (w c)) + - (moved_fl (x c) (v c) - moved_fl (y c) (w c) - offset_exact c)) by ring.
apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_Ropp.
assert (T := Rabs_triang (moved_fl (x c) (v c)) (- moved_fl (y c) (w c))); rewrite Rabs_Ropp in T; lra.
Qed.

(* The sum of the absolute values of a vector in three dimensions is at most sqrt 3 times its length. *)
Fixpoint sum_abs (r : nat -> R) k := match k with O => 0 | S k => sum_abs r k + Rabs (r k) end.
Lemma sum_abs_small r : sum_abs r k <= 1.7321 * sqrt (dot r r k).
Proof.
assert (s0 : 0 <= sum_abs r k) by (clear; induction k as [| j IH]; cbn [sum_abs]; [lra | assert (H := Rabs_pos (r j)); lra]).
assert (d0 : 0 <= dot r r k) by apply (square_nonneg k r).
assert (q0 := sqrt_pos (dot r r k)); assert (qq := sqrt_sqrt _ d0); set (q := sqrt (dot r r k)) in *.
assert (key : sum_abs r k * sum_abs r k <= 3 * dot r r k).
  assert (sq : forall j, r j * r j = Rabs (r j) * Rabs (r j)) by (intro j; rewrite <- Rabs_mult, Rabs_pos_eq; [reflexivity | apply Rle_0_sqr]).
  clear s0 d0 q0 qq q; destruct k as [| [| [| [| j]]]]; [| | | | lia]; cbn [sum_abs dot]; rewrite ?sq.
  - lra.
  - assert (0 <= Rabs (r 0%nat) * Rabs (r 0%nat)) by apply Rle_0_sqr; lra.
  - set (a := Rabs (r 0%nat)); set (b := Rabs (r 1%nat)); assert (0 <= (a - b) * (a - b)) by apply Rle_0_sqr.
    assert (0 <= a * a) by apply Rle_0_sqr; assert (0 <= b * b) by apply Rle_0_sqr; lra.
  - set (a := Rabs (r 0%nat)); set (b := Rabs (r 1%nat)); set (c := Rabs (r 2%nat)).
    assert (0 <= (a - b) * (a - b)) by apply Rle_0_sqr; assert (0 <= (b - c) * (b - c)) by apply Rle_0_sqr; assert (0 <= (a - c) * (a - c)) by apply Rle_0_sqr; lra.
destruct (Rle_lt_dec (sum_abs r k) (1.7321 * q)) as [le | lt]; [exact le | exfalso].
assert (0 <= 1.7321 * q) by lra.
assert (1.7321 * q * (1.7321 * q) <= sum_abs r k * (1.7321 * q)) by (apply Rmult_le_compat_r; lra).
assert (sum_abs r k * (1.7321 * q) <= sum_abs r k * sum_abs r k) by (apply Rmult_le_compat_l; lra).
destruct (Req_dec q 0) as [z | ne].
  rewrite z in *; assert (0 < sum_abs r k * sum_abs r k) by (apply Rmult_lt_0_compat; lra); lra.
assert (0 < q * q) by (apply Rmult_lt_0_compat; lra); lra.
Qed.

Lemma dot_moved (r r' : nat -> R) t j : 0 <= t -> (forall c, Rabs (r' c - r c) <= t) ->
  Rabs (dot r' r' j - dot r r j) <= 2 * t * sum_abs r j + INR j * (t * t).
Proof.
intros t0 wrong; induction j as [| j IH]; [simpl; rewrite Rminus_0_r, Rabs_R0; lra |].
cbn [dot sum_abs]; rewrite S_INR; assert (wj := wrong j); set (z := r' j - r j) in *.
assert (one : Rabs (r' j * r' j - r j * r j) <= 2 * t * Rabs (r j) + t * t).
  replace (r' j * r' j - r j * r j) with (z * (2 * r j + z)) by (unfold z; ring); rewrite Rabs_mult.
  apply Rle_trans with (t * (2 * Rabs (r j) + t)); [| lra].
  apply Rmult_le_compat; try apply Rabs_pos; [exact wj |].
  apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_mult, (Rabs_pos_eq 2) by lra; lra.
replace (_ - _) with ((dot r' r' j - dot r r j) + (r' j * r' j - r j * r j)) by ring.
apply Rle_trans with (1 := Rabs_triang _ _); lra.
Qed.

Lemma dot_small (r : nat -> R) B j : (forall c, Rabs (r c) <= B) -> dot r r j <= INR j * (B * B).
Proof.
intro small; induction j as [| j IH]; [simpl; lra |]; cbn [dot]; rewrite S_INR; assert (wj := small j).
assert (r j * r j <= B * B).
  rewrite <- (Rabs_pos_eq (r j * r j)) by apply Rle_0_sqr; rewrite Rabs_mult; apply Rmult_le_compat; try apply Rabs_pos; exact wj.
lra.
Qed.

Theorem distance_after_move : Rabs (D' - D) <= 2.4e-15 * (span * sqrt D) + 2e-30 * (span * span) + 1e-270.
Proof.
assert (U := u_value); assert (n0 := eta_pos); assert (small := eta_small); assert (l := least_small).
assert (e0 : 0 <= e) by (unfold e; rewrite U; lra).
assert (d0 : 0 <= D) by apply (square_nonneg k offset_exact); assert (q0 := sqrt_pos D); assert (qq := sqrt_sqrt _ d0).
assert (near_all : Rabs (D' - D) <= 2 * (2 * e) * sum_abs offset_exact k + INR k * (4 * (e * e))).
  replace (4 * (e * e)) with (2 * e * (2 * e)) by ring; apply dot_moved; [lra | exact offset_near].
assert (A := sum_abs_small offset_exact); fold D in A.
assert (K : INR k <= 3) by (replace 3 with (INR 3) by (simpl; lra); apply le_INR; exact k3).
assert (top : D <= 3 * ((2 * span + 2 * e) * (2 * span + 2 * e))).
  assert (B := dot_small offset_exact (2 * span + 2 * e) k offset_small); fold D in B.
  assert (0 <= (2 * span + 2 * e) * (2 * span + 2 * e)) by apply Rle_0_sqr.
  assert (INR k * ((2 * span + 2 * e) * (2 * span + 2 * e)) <= 3 * ((2 * span + 2 * e) * (2 * span + 2 * e))) by (apply Rmult_le_compat_r; assumption); lra.
assert (ee : 0 <= e * e) by (apply Rmult_le_pos; lra).
assert (s1 : 2 * (2 * e) * sum_abs offset_exact k <= 2 * (2 * e) * (1.7321 * sqrt D)) by (apply Rmult_le_compat_l; lra).
assert (s2 : INR k * (4 * (e * e)) <= 3 * (4 * (e * e))) by (apply Rmult_le_compat_r; lra).
assert (q1 : sqrt D <= 1e10).
  rewrite <- (sqrt_square 1e10) by lra; apply sqrt_le_1; [lra | lra |].
  apply Rle_trans with (1 := top); assert (e1 : e <= 1) by (unfold e; rewrite U; lra).
  assert ((2 * span + 2 * e) * (2 * span + 2 * e) <= 2.1e9 * 2.1e9) by (apply Rmult_le_compat; lra); lra.
assert (tq : eta * sqrt D <= eta * 1e10) by (apply Rmult_le_compat_l; lra).
assert (ts : eta * span <= eta * 1e9) by (apply Rmult_le_compat_l; lra); assert (tt : eta * eta <= eta * 1) by (apply Rmult_le_compat_l; lra).
assert (SS : 0 <= span * span) by (apply Rmult_le_pos; lra); assert (Sq : 0 <= span * sqrt D) by (apply Rmult_le_pos; lra).
assert (T := least_is 1e12 ltac:(lra)); assert (T1 : 1e12 * eta <= 1e-271) by lra.
apply Rle_trans with (1 := near_all); unfold e in *; rewrite U in *; lra.
Qed.

Theorem tolerance_of_places : 3e-15 * span <= sqrt D -> Rabs (D' - D) <= 1e-14 * (span * sqrt D) + 1e-270.
Proof.
intro apart; assert (H := distance_after_move); assert (q0 := sqrt_pos D).
assert (span * (3e-15 * span) <= span * sqrt D) by (apply Rmult_le_compat_l; lra); assert (0 <= span * sqrt D) by (apply Rmult_le_pos; lra); lra.
Qed.
End Moves.

(* What is kept, less what a tick may take and what rounding adds. *)
Theorem drift (g : nat -> R) gamma e : 0 <= gamma <= 1 -> 0 <= e -> 0 <= g O -> (forall p, g (S p) >= g p - gamma * Rmax (g p) 0 - e) ->
  forall p, - (INR p * e) <= g p.
Proof.
intros part e0 start tick; induction p as [| p IH]; [simpl; lra |]; assert (T := tick p); rewrite S_INR; assert (P := pos_INR p).
assert (pe : 0 <= INR p * e) by (apply Rmult_le_pos; lra).
unfold Rmax in T; destruct (Rle_dec (g p) 0) as [neg | pos]; [lra |].
assert (gamma * g p <= 1 * g p) by (apply Rmult_le_compat_r; lra); lra.
Qed.
