(* The two forms of rows must not be mixed in one team (docs/theory/budget.md, sec:mixing).

   In words. There are three robots, all normal, that see each other exactly, and none is closer to another than 0.8 m. Robot K moves by
   (far), J1 and J2 by (far'), all three by (near); each has h > 0 and needs one neighbour. Every row of every robot holds. After
   the tick h of K is negative.

   The weight is that of the paper with R = 3 m, q1 = 2.1, q2 = 0.25, and the bounds L and kappa are those that slope_bound and
   K_bound prove. gamma is 1, the largest that is allowed: then a sound form keeps h >= 0 and the mixture does not. The reason:
   with (far) K may take half of its h, link by link, and with (far') its two neighbours may take two thirds. *)

From Coq Require Import Reals Lra Psatz.
From Interval Require Import Tactic.
From Closeranks Require Import intervals weights curvature.
Import ExactIntervals.
Local Open Scope R_scope.

Inductive robot := K | J1 | J2.
Definition next i := match i with K => J1 | J1 => J2 | J2 => K end.

(* Points and moves in the plane. *)
Definition point := (R * R)%type.
Definition minus (p q : point) : point := (fst p - fst q, snd p - snd q).
Definition plus (p q : point) : point := (fst p + fst q, snd p + snd q).
Definition dot (p q : point) := fst p * fst q + snd p * snd q.
Definition sq p := dot p p.

Definition radius2 := 9.
Definition a p q := weights.weight 2.1 0.25 radius2 (sq (minus p q)).
Definition slope p q := f 2.1 0.25 (Rmax (radius2 - sq (minus p q)) 0).
Definition L := 0.3936 * 2.1 * sqrt 0.25.
Definition kappa := 0.7872 * 2.1 * sqrt 0.25 + 1.836 * radius2 * (2.1 * 0.25).

Section Rows.
Variables x v : robot -> point.
Definition h i := a (x i) (x (next i)) + a (x i) (x (next (next i))) - 1.
Definition r i j := minus (x i) (x j).
(* - grad . v, with the gradient of the weight of i and j with respect to the position of i *)
Definition falls i j := 2 * slope (x i) (x j) * dot (r i j) (v i).

(* Everybody is a neighbour of everybody, so all degrees are 2, and what is seen is h itself. *)
Definition far_for i j := dot (r i j) (v i) + sq (v i) <= Rmin (h i / 2) (h j / 2) / (4 * L).
Definition far i := far_for i (next i) /\ far_for i (next (next i)).
Definition far_prime_for i j := falls i j + kappa * sq (v i) <= h j / 3.
Definition far_prime i := far_prime_for i (next i) /\ far_prime_for i (next (next i)) /\
  falls i (next i) + falls i (next (next i)) + (kappa + kappa) * sq (v i) <= h i / 3.
Definition near_for i j := -2 * dot (r i j) (v i) <= 0.2 / 2 * (sq (r i j) - 0.8 * 0.8).
Definition near i := near_for i (next i) /\ near_for i (next (next i)).
Definition apart i j := 0.8 * 0.8 <= sq (r i j) <= radius2.
End Rows.

Definition start i : point := match i with K => (0, 0) | J1 => (2.6, 0.438) | J2 => (2.6, - 0.438) end.
Definition move i : point := match i with K => (- 0.00118, 0) | _ => (0.00157, 0) end.
Definition after i := plus (start i) (move i).

(* The bounds are bounds: of the slope of a weight, and of how it bends. *)
Lemma L_is_bound s : 0 <= s -> f 2.1 0.25 s <= L.
Proof. intro; apply slope_bound; lra. Qed.
Lemma kappa_is_bound s : 0 <= s <= radius2 -> curvature.K 2.1 0.25 radius2 s <= kappa.
Proof. intro; apply K_bound; lra. Qed.

Ltac numbers := cbv [far far_for far_prime far_prime_for near near_for falls h a slope r sq dot minus plus start move after next fst snd
  weights.weight rise f L kappa radius2].
Ltac simple := repeat (rewrite Rmax_left; [| lra]); interval with (i_prec 60).

Theorem mixed_rows_fail :
  (forall i, 0 < h start i) /\ (forall i, apart start i (next i)) /\
  (far start move K /\ far_prime start move J1 /\ far_prime start move J2 /\ forall i, near start move i) /\
  h after K < 0.
Proof.
assert (pos : 0.0102 < h start K < 0.0103) by (numbers; split; simple).
assert (pos1 : 0.55 < h start J1) by (numbers; simple).
assert (pos2 : 0.55 < h start J2) by (numbers; simple).
split; [intros []; lra |].
split; [intros []; unfold apart; numbers; lra |].
split; [| numbers; simple].
split.
  assert (lim : forall j, 0.55 < h start j -> 0.0051 / (4 * L) <= Rmin (h start K / 2) (h start j / 2) / (4 * L)).
    intros j hj; apply Rmult_le_compat_r; [numbers; interval with (i_prec 60) |]; apply Rmin_glb; lra.
  split; unfold far_for.
  - apply Rle_trans with (2 := lim _ pos1); numbers; interval with (i_prec 60).
  - apply Rle_trans with (2 := lim _ pos2); numbers; interval with (i_prec 60).
assert (third : forall i j, 0.0102 <= h start j -> falls start move i j + kappa * sq (move i) <= 0.0034 -> far_prime_for start move i j).
  intros i j; unfold far_prime_for; lra.
split; [| split].
- unfold far_prime; cbn [next]; split; [apply third; [lra | numbers; simple] | split; [apply third; [lra | numbers; simple] |]].
  apply Rle_trans with 0.1; [numbers; simple | lra].
- unfold far_prime; cbn [next]; split; [apply third; [lra | numbers; simple] | split; [apply third; [lra | numbers; simple] |]].
  apply Rle_trans with 0.1; [numbers; simple | lra].
- intros []; split; numbers; lra.
Qed.
