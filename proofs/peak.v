(* Where the slope of a weight is largest (docs/theory/weights.md, eq:slope-bound).

   In words. f rises with s until 4 z tanh z = 1, with z = q2 s^2/2, and falls from there. So the largest f on an interval is at its
   point closest to that s*: what the code takes for L. `turn` is 4 z tanh z. *)

From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import vectors weights curvature.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Section Peak.
Variables q1 q2 : R.
Hypothesis q1_nonneg : 0 <= q1.
Hypothesis q2_pos : 0 < q2.
Let e s := exp (- (q2 * (s * s))).
Definition turn s := 2 * q2 * (s * s) * (1 - e s) / (1 + e s).

Lemma f'_turn s : f' q1 q2 s = 2 * q1 * q2 * e s / ((1 + e s) * (1 + e s)) * (1 - turn s).
Proof. by []. Qed.

Lemma turn_mono s t : 0 <= s <= t -> turn s <= turn t.
Proof.
move=> [s0 st]; have es : 0 < e s by exact: exp_pos.
have et : 0 < e t by exact: exp_pos.
have sq : s * s <= t * t by nra.
have ee : e t <= e s.
  case: (Req_dec (s * s) (t * t)) => [E | ne]; first by rewrite /e E; lra.
  by apply/Rlt_le/exp_increasing; nra.
have e1 : e s <= 1.
  have le : - (q2 * (s * s)) <= 0 by nra.
  by rewrite -exp_0 /e; case: le => [lt | ->]; [apply/Rlt_le/exp_increasing | apply: Rle_refl].
have part c : 0 < c -> (1 - c) / (1 + c) = 2 / (1 + c) - 1 by move=> c0; field; lra.
have inv : 2 / (1 + e s) <= 2 / (1 + e t) by apply: Rmult_le_compat_l; [lra | apply: Rinv_le_contravar; lra].
have low : 0 <= (1 - e s) / (1 + e s) by apply: Rmult_le_pos; [lra | apply/Rlt_le/Rinv_0_lt_compat; lra].
have up : (1 - e s) / (1 + e s) <= (1 - e t) / (1 + e t) by rewrite !part //; lra.
have E c : turn c = 2 * q2 * (c * c) * ((1 - e c) / (1 + e c)) by rewrite /turn /Rdiv; ring.
rewrite (E s) (E t); apply: Rmult_le_compat => //; nra.
Qed.

Lemma between a b : a <= b -> exists c, a <= c <= b /\ f q1 q2 b - f q1 q2 a = f' q1 q2 c * (b - a).
Proof.
move=> ab; have [c [cin E]] : exists c, Rmin a b <= c <= Rmax a b /\ f q1 q2 b - f q1 q2 a = f' q1 q2 c * (b - a).
  apply: MVT_gen => c cin; first exact: f_derive.
  by apply: derivable_continuous_pt; exists (f' q1 q2 c); apply/is_derive_Reals/f_derive.
by exists c; move: cin; rewrite Rmin_left ?Rmax_right.
Qed.

Lemma front c : 0 <= 2 * q1 * q2 * e c / ((1 + e c) * (1 + e c)).
Proof.
have ec : 0 < e c by exact: exp_pos.
apply: Rmult_le_pos; last by apply/Rlt_le/Rinv_0_lt_compat; nra.
by apply: Rmult_le_pos; [nra | lra].
Qed.

Variable star : R.
Hypothesis star_pos : 0 <= star.
Hypothesis turns : turn star = 1.

Lemma before a b : 0 <= a -> a <= b -> b <= star -> f q1 q2 a <= f q1 q2 b.
Proof.
move=> a0 ab bs; have [c [cin E]] := between ab; rewrite f'_turn in E.
have := @turn_mono c star ltac:(lra); rewrite turns => le; have := front c => fr.
have : 0 <= 2 * q1 * q2 * e c / ((1 + e c) * (1 + e c)) * (1 - turn c) by apply: Rmult_le_pos; lra.
move=> pos; have : 0 <= 2 * q1 * q2 * e c / ((1 + e c) * (1 + e c)) * (1 - turn c) * (b - a) by apply: Rmult_le_pos; lra.
lra.
Qed.

Lemma behind a b : star <= a -> a <= b -> f q1 q2 b <= f q1 q2 a.
Proof.
move=> sa ab; have [c [cin E]] := between ab; rewrite f'_turn in E.
have := @turn_mono star c ltac:(lra); rewrite turns => le; have := front c => fr.
have : 0 <= 2 * q1 * q2 * e c / ((1 + e c) * (1 + e c)) * (turn c - 1) by apply: Rmult_le_pos; lra.
move=> pos; have : 0 <= 2 * q1 * q2 * e c / ((1 + e c) * (1 + e c)) * (turn c - 1) * (b - a) by apply: Rmult_le_pos; lra.
lra.
Qed.

(* eq:slope-bound: L is f at the point of the interval closest to the peak. *)
Theorem largest_slope lo hi s : 0 <= lo -> lo <= s <= hi -> f q1 q2 s <= f q1 q2 (Rmax lo (Rmin hi star)).
Proof.
move=> lo0 [l h]; case: (Rle_lt_dec star lo) => sl.
  by rewrite Rmax_left; [apply: behind; lra | apply: Rle_trans (Rmin_r _ _) sl].
case: (Rle_lt_dec hi star) => hs.
  by rewrite (Rmin_left hi star) // Rmax_right; [apply: before; lra | lra].
rewrite (Rmin_right hi star); last lra.
rewrite Rmax_right; last lra.
by case: (Rle_lt_dec s star) => ss; [apply: before; lra | apply: behind; lra].
Qed.
End Peak.
