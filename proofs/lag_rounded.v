(* What is rounded when bodies with a lag move (crates/sim/src/plant/lag.rs; docs/theory/errors.md).

   In words. A body has the velocity w and is given u. In a tick T, with the time constant tau and e = exp(- T/tau), its coordinate x becomes x + T u + tau (1 - e) (w - u) and its velocity
   u + e (w - u), in doubles with every operation rounded, e among them. T/tau is at most 690, tau and V at most 1e6, no coordinate is larger than S, at most 1e9, and no velocity is larger
   than V.

   `lag_move_error`: the new coordinate is wrong by at most 4.1 u S + 16 u tau V + 1e8 * 2^-1075, with u = 2^-53.
   `lag_speed_error`: the new velocity is wrong by at most 13 u V + 1e8 * 2^-1075.
   `lag_away`: after p ticks from rest the body is at most tau |w| + p (7.2 u S + 30 u tau V + 1e15 * 2^-1075) from where the velocities it was given would have taken it, as that is computed too.
   In real numbers it is exactly tau |w| away. With S = 10 m, tau = 0.1 s and V = 1.5 m/s the second term is below 9e-10 m after 100,000 ticks.

   The point ahead of a body with wheels (crates/sim/src/plant/unicycle.rs) moves as in moves_rounded.v. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Interval Require Import Tactic.
From Closeranks Require Import intervals rounding exponential link_rounded slope_rounded slope_max_rounded bend_test_rounded moves_rounded.
Import ExactIntervals.
Local Open Scope R_scope.

Section Lag.
Variables T tau span V : R.
Hypothesis T_pos : 0 < T.
Hypothesis tau_range : 0 < tau <= 1e6.
Hypothesis long_enough : T / tau <= 690.
Hypothesis span_range : 0 <= span <= 1e9.
Hypothesis V_range : 0 <= V <= 1e6.
Let e := exp (- (T / tau)).

Definition stays_fl := exp_fl (fl (- T / tau)).
Definition back_fl := fl (tau * fl (1 - stays_fl)).
Definition behind_fl v w := fl (w - v).
Definition place_fl x v w := fl (moved_fl T x v + fl (back_fl * behind_fl v w)).
Definition speed_fl v w := fl (v + fl (stays_fl * behind_fl v w)).
Definition place x v w := x + T * v + tau * (1 - e) * (w - v).
Definition speed v w := v + e * (w - v).

Lemma e_range : 0 < e <= 1 /\ 0 < T / tau /\ T / tau * e <= 1.
Proof.
assert (z0 : 0 < T / tau) by (apply Rmult_lt_0_compat; [exact T_pos | apply Rinv_0_lt_compat; lra]).
assert (e0 : 0 < e) by apply exp_pos; assert (H := exp_ineq1_le (T / tau)); assert (inv_e : exp (T / tau) * e = 1) by (unfold e; rewrite <- exp_plus, Rplus_opp_r; apply exp_0).
assert ((1 + T / tau) * e <= exp (T / tau) * e) by (apply Rmult_le_compat_r; lra).
assert (0 <= T / tau * e) by (apply Rmult_le_pos; lra); lra.
Qed.

Lemma stays_near : Rabs (stays_fl - e) <= 3.6 * u.
Proof.
destruct e_range as [e0 [z0 flat]]; assert (U := u_value); assert (n := eta_small); assert (l := least_small); assert (n0 := eta_pos).
unfold stays_fl; replace (- T / tau) with (- (T / tau)) by (unfold Rdiv; ring); set (z := T / tau) in *.
assert (F := fl_error (- z)); rewrite Rabs_Ropp, (Rabs_pos_eq z) in F by lra; set (x := fl (- z)) in *; set (d := x - - z) in *.
assert (small : Rabs d <= 2e-13) by (apply Rle_trans with (1 := F); rewrite U; lra).
assert (x700 : -700 <= x <= 700) by (apply Rabs_le_inv in small; unfold d in small; lra).
assert (X := exp_error x x700); assert (D := near_exp d small); assert (is : exp x = e * exp d) by (unfold e; rewrite <- exp_plus; f_equal; unfold d; ring).
rewrite is in X; assert (cap : exp d <= 1.001) by (apply near in D; lra).
replace (exp_fl x - e) with ((exp_fl x - e * exp d) + e * (exp d - 1)) by ring; apply Rle_trans with (1 := Rabs_triang _ _).
rewrite Rabs_mult, (Rabs_pos_eq e) by lra; assert (p1 : e * Rabs (exp d - 1) <= e * (1.01 * (u * z + eta))) by (apply Rmult_le_compat_l; lra).
assert (p2 : e * exp d <= 1 * 1.001) by (apply Rmult_le_compat; lra || apply Rlt_le, exp_pos).
assert (p3 : e * eta <= 1 * eta) by (apply Rmult_le_compat_r; lra); rewrite U in *; lra.
Qed.

Lemma back_near : Rabs (back_fl - tau * (1 - e)) <= 5.8 * u * tau + eta.
Proof.
destruct e_range as [e0 _]; assert (S := stays_near); assert (U := u_value); assert (n := eta_small); assert (l := least_small); assert (n0 := eta_pos).
assert (a : Rabs (1 - stays_fl - (1 - e)) <= 3.6 * u) by (replace (_ - _) with (- (stays_fl - e)) by ring; rewrite Rabs_Ropp; exact S).
assert (b := fl_of _ _ _ 1 a ltac:(rewrite Rabs_pos_eq; lra)); set (o := fl (1 - stays_fl)) in *.
assert (c : Rabs (o - (1 - e)) <= 4.7 * u) by (apply Rle_trans with (1 := b); rewrite U; lra).
assert (p : Rabs (tau * o - tau * (1 - e)) <= tau * (4.7 * u)).
  rewrite <- Rmult_minus_distr_l, Rabs_mult, (Rabs_pos_eq tau) by lra; apply Rmult_le_compat_l; lra.
assert (te : 0 <= tau * (1 - e) <= tau * 1) by (split; [apply Rmult_le_pos | apply Rmult_le_compat_l]; lra).
unfold back_fl; fold o; apply Rle_trans with (1 := fl_of _ _ _ tau p ltac:(rewrite Rabs_pos_eq; lra)); rewrite U; lra.
Qed.

Section Tick.
Variables x v w : R.
Hypothesis v_small : Rabs v <= V.
Hypothesis w_small : Rabs w <= V.

Lemma behind_size : Rabs (w - v) <= 2 * V.
Proof. apply Rabs_le_inv in v_small; apply Rabs_le_inv in w_small; apply Rabs_le; lra. Qed.

Lemma behind_near : Rabs (behind_fl v w - (w - v)) <= 2 * u * V + eta.
Proof.
assert (F := fl_error (w - v)); assert (B := behind_size); assert (P := u_pos); unfold behind_fl.
assert (u * Rabs (w - v) <= u * (2 * V)) by (apply Rmult_le_compat_l; lra); lra.
Qed.

Theorem lag_speed_error : Rabs (speed_fl v w - speed v w) <= 13 * u * V + 1e8 * eta.
Proof.
destruct e_range as [e0 _]; assert (S := stays_near); assert (B := behind_near); assert (Z := behind_size); assert (U := u_value); assert (n := eta_small); assert (l := least_small); assert (n0 := eta_pos).
assert (M := times_near _ _ _ _ _ _ 1 (2 * V) S B ltac:(rewrite Rabs_pos_eq; lra) Z).
assert (m : Rabs (e * (w - v)) <= 2 * V) by (rewrite Rabs_mult, (Rabs_pos_eq e) by lra; apply Rle_trans with (1 * (2 * V)); [apply Rmult_le_compat; try apply Rabs_pos; lra | lra]).
assert (N := fl_of _ _ _ _ M m); set (t := fl (stays_fl * behind_fl v w)) in *.
assert (sum : Rabs (v + t - speed v w) <= 11.4 * u * V + 4 * eta).
  replace (v + t - speed v w) with (t - e * (w - v)) by (unfold speed; ring); apply Rle_trans with (1 := N); rewrite U; lra.
assert (top : Rabs (speed v w) <= V).
  assert (a := Rabs_le_inv _ _ v_small); assert (b := Rabs_le_inv _ _ w_small); unfold speed.
  replace (v + e * (w - v)) with ((1 - e) * v + e * w) by ring.
  assert (0 <= (1 - e) * (V - v)) by (apply Rmult_le_pos; lra); assert (0 <= (1 - e) * (V + v)) by (apply Rmult_le_pos; lra).
  assert (0 <= e * (V - w)) by (apply Rmult_le_pos; lra); assert (0 <= e * (V + w)) by (apply Rmult_le_pos; lra); apply Rabs_le; lra.
unfold speed_fl; fold t; apply Rle_trans with (1 := fl_of _ _ _ _ sum top); rewrite U; lra.
Qed.

Hypothesis before : Rabs x <= span.
Hypothesis between : Rabs (moved_fl T x v) <= span.
Hypothesis after : Rabs (place_fl x v w) <= span.

Theorem lag_move_error : Rabs (place_fl x v w - place x v w) <= 4.1 * u * span + 16 * u * (tau * V) + 1e8 * eta.
Proof.
destruct e_range as [e0 _]; assert (S := back_near); assert (B := behind_near); assert (Z := behind_size); assert (U := u_value); assert (n := eta_small); assert (l := least_small); assert (n0 := eta_pos).
assert (te : 0 <= tau * (1 - e) <= tau * 1) by (split; [apply Rmult_le_pos | apply Rmult_le_compat_l]; lra).
assert (M := times_near _ _ _ _ _ _ tau (2 * V) S B ltac:(rewrite Rabs_pos_eq; lra) Z).
assert (m : Rabs (tau * (1 - e) * (w - v)) <= tau * (2 * V)) by (rewrite Rabs_mult, (Rabs_pos_eq (tau * _)) by lra; apply Rmult_le_compat; try apply Rabs_pos; lra).
assert (N := fl_of _ _ _ _ M m); unfold place_fl in *; set (t := fl (back_fl * behind_fl v w)) in *; set (y := moved_fl T x v) in *.
assert (tV : 0 <= tau * V) by (apply Rmult_le_pos; lra).
assert (tn : tau * eta <= 1e6 * eta) by (apply Rmult_le_compat_r; lra); assert (Vn : V * eta <= 1e6 * eta) by (apply Rmult_le_compat_r; lra).
assert (nn : eta * eta <= 1 * eta) by (apply Rmult_le_compat_r; lra).
assert (part : Rabs (t - tau * (1 - e) * (w - v)) <= 15.8 * u * (tau * V) + 5e6 * eta).
  apply Rle_trans with (1 := N); rewrite U; lra.
assert (A := move_error T span span_range x v before between); fold y in A.
assert (sum : Rabs (y + t - place x v w) <= 3.002 * u * span + 15.8 * u * (tau * V) + 6e6 * eta).
  replace (y + t - place x v w) with ((y - moved T x v) + (t - tau * (1 - e) * (w - v))) by (unfold place, moved; ring).
  apply Rle_trans with (1 := Rabs_triang _ _); lra.
assert (F := fl_error (y + t)); set (r := fl (y + t)) in *.
assert (size : Rabs (y + t) <= span + (u * Rabs (y + t) + eta)).
  replace (y + t) with (r + - (r - (y + t))) at 1 by ring; apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_Ropp; lra.
assert (p := Rabs_pos (y + t)); replace (r - place x v w) with ((r - (y + t)) + (y + t - place x v w)) by ring.
apply Rle_trans with (1 := Rabs_triang _ _); rewrite U in *; lra.
Qed.
End Tick.

(* A run from rest. r is where the velocities alone would have taken the body. *)
Variables x r v w : nat -> R.
Hypothesis at_rest : x O = r O /\ w O = 0.
Hypothesis ticks : forall p, x (S p) = place_fl (x p) (v p) (w p) /\ r (S p) = moved_fl T (r p) (v p) /\ w (S p) = speed_fl (v p) (w p).
Hypothesis slow : forall p, Rabs (v p) <= V /\ Rabs (w p) <= V.
Hypothesis inside : forall p, Rabs (x p) <= span /\ Rabs (r p) <= span /\ Rabs (moved_fl T (x p) (v p)) <= span.

Lemma lag_kept p : Rabs (x p - r p + tau * w p) <= INR p * (7.2 * u * span + 30 * u * (tau * V) + 1e15 * eta).
Proof.
assert (n0 := eta_pos); induction p as [| p IH].
  destruct at_rest as [-> ->]; simpl; rewrite Rminus_diag_eq, Rmult_0_r, Rplus_0_l, Rabs_R0 by reflexivity; lra.
destruct (ticks p) as [xp [rp wp]]; destruct (slow p) as [vs ws]; destruct (inside p) as [xi [ri mi]]; destruct (inside (S p)) as [xi' [ri' _]].
rewrite xp in xi'; rewrite rp in ri'; assert (A := lag_move_error (x p) (v p) (w p) vs ws xi mi xi'); assert (B := move_error T span span_range (r p) (v p) ri ri').
assert (C := lag_speed_error (v p) (w p) vs ws); assert (C' : Rabs (tau * (speed_fl (v p) (w p) - speed (v p) (w p))) <= tau * (13 * u * V + 1e8 * eta)).
  rewrite Rabs_mult, (Rabs_pos_eq tau) by lra; apply Rmult_le_compat_l; lra.
assert (tn : tau * eta <= 1e6 * eta) by (apply Rmult_le_compat_r; lra); assert (tV : 0 <= u * (tau * V)) by (assert (P := u_pos); apply Rmult_le_pos; [lra | apply Rmult_le_pos; lra]).
rewrite xp, rp, wp, S_INR.
replace (place_fl (x p) (v p) (w p) - moved_fl T (r p) (v p) + tau * speed_fl (v p) (w p)) with
  ((x p - r p + tau * w p) + (place_fl (x p) (v p) (w p) - place (x p) (v p) (w p)) - (moved_fl T (r p) (v p) - moved T (r p) (v p)) +
   tau * (speed_fl (v p) (w p) - speed (v p) (w p))) by (unfold place, moved, speed; ring).
assert (us : 0 <= u * span) by (assert (P := u_pos); apply Rmult_le_pos; lra).
apply Rabs_le_inv in IH; apply Rabs_le_inv in A; apply Rabs_le_inv in B; apply Rabs_le_inv in C'; apply Rabs_le; lra.
Qed.

Theorem lag_away p : Rabs (x p - r p) <= tau * Rabs (w p) + INR p * (7.2 * u * span + 30 * u * (tau * V) + 1e15 * eta).
Proof.
assert (H := lag_kept p); replace (x p - r p) with ((x p - r p + tau * w p) + - (tau * w p)) by ring.
apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_Ropp, Rabs_mult, (Rabs_pos_eq tau) by lra; lra.
Qed.
End Lag.
