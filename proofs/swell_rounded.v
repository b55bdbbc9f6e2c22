(* The eigenvalue along r of the Hessian of a weight, as it is computed (crates/core/src/controller/budget/curvature.rs: `swell`; docs/theory/weights.md:
   eq:gradient-error).

   In words. 0 < q1 <= 4, 0 < q2 <= 1e15, R^2 as it is stored is at most 1e13, and sqrt(q2) R^2 <= 151. `swell` is 2 f(s)/s (2 (R^2 - s) (1 - T) - s), with T = 4 z tanh z, a difference that may lose many
   digits. Where it is at most K(s) it need not be known, because the code takes the larger of the two. Where it is more (`swell_low`), what is computed is at least
   (1 - 8e-13) of it, less 1e-255.

   `turn_below`: below the peak of f the computed T is wrong by at most 18 u. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Interval Require Import Tactic.
From Closeranks Require Import intervals weights curvature peak bend_peak rounding exponential weight_rounded link_rounded slope_rounded slope_max_rounded
  bend_rounded bend_gap bend_test_rounded gradient_error.
Import ExactIntervals.
Local Open Scope R_scope.

Section Swell.
Variables q1 q2 R2 : R.
Hypothesis q1_range : 0 < q1 <= 4.
Hypothesis q2_range : 0 < q2 <= 1e15.
Hypothesis R2_range : 0 <= R2 <= 1e13.
Hypothesis steep : sqrt q2 * R2 <= 151.
Variable far : R -> R.
Hypothesis far_nonneg : forall x, 0 <= far x.

Definition swell_fl s := fl (fl (2 * factor_fl q1 q2 (tail_fl q2 far s)) * fl (fl (fl (2 * fl (R2 - s)) * fl (1 - turn_fl q2 far s)) - s)).

Variable s : R.
Hypothesis s_range : 0 <= s <= R2.
Let z := q2 * (s * s).
Let E := exp (- z).
Let J := / (1 + E).
Let front := 2 * q1 * q2 * E * J * J.
Let T := turn q2 s.
Let W := R2 - s.
Let x := sqrt q2 * s.

Lemma swell_is : swell q1 q2 R2 s = 2 * front * (2 * W * (1 - T) - s).
Proof.
unfold swell; rewrite f'_turn; fold T z E; assert (e0 : 0 < E) by apply exp_pos.
assert (is : 2 * q1 * q2 * E / ((1 + E) * (1 + E)) = front) by (unfold front, J; field; lra).
assert (fs : f q1 q2 s = front * s) by (unfold f; fold z E; unfold front, J; field; lra).
rewrite is, fs; unfold W; ring.
Qed.

Lemma front_range : 0 <= front <= 8e15.
Proof.
assert (e0 := E_range q2 q2_range s ltac:(lra)); fold z in e0; fold E in e0; assert (j0 := J_range q2 q2_range s ltac:(lra)); fold z in j0; fold E in j0; fold J in j0.
assert (a1 := small_product (2 * q1) q2 8 1e15 ltac:(lra) ltac:(lra)); assert (a2 := small_product _ E _ 1 a1 ltac:(lra)).
assert (a3 := small_product _ J _ 1 a2 ltac:(lra)); assert (a4 := small_product _ J _ 1 a3 ltac:(lra)); unfold front; lra.
Qed.

Section Below.
Hypothesis below : T < 1.

Lemma z_below : 0 <= z <= 1.05.
Proof.
assert (q2_pos : 0 < q2) by lra; destruct (steepest q2_pos) as [star [star0 [turns Z]]]; unfold steepest_z in Z; apply near in Z.
assert (ss : s < star).
  destruct (Rle_lt_dec star s) as [le | lt]; [exfalso | exact lt].
  assert (m := @turn_mono q2 q2_pos star s ltac:(lra)); rewrite turns in m; fold T in m; lra.
assert (sq : s * s <= star * star) by (apply Rmult_le_compat; lra).
split; [unfold z; apply Rmult_le_pos; [lra | apply Rmult_le_pos; lra] |].
unfold z; apply Rle_trans with (q2 * (star * star)); [apply Rmult_le_compat_l; lra | lra].
Qed.

Lemma turn_below : Rabs (turn_fl q2 far s - T) <= 18 * u /\ 0 <= T.
Proof.
assert (Z := z_below); assert (n0 := eta_pos); assert (s13 : 0 <= s <= 1e13) by lra; assert (z690 : z <= 690) by lra; assert (U := u_value).
assert (T0 := T_range q2 R2 q2_range s s_range z690); fold T in T0; split; [| lra].
assert (e0 := E_range q2 q2_range s s13); fold z in e0; fold E in e0; assert (Tc := tail_close q2 q2_range far s s13 z690); fold z in Tc; fold E in Tc.
assert (I := inverse_close q2 q2_range far s s13 z690); fold z in I; fold E in I; fold J in I.
assert (E1 : 0.349 <= E).
  apply Rle_trans with (exp (- (1.05))); [clear; interval with (i_prec 60) |].
  unfold E; destruct (Req_dec z 1.05) as [-> | ne]; [lra | apply Rlt_le, exp_increasing; lra].
assert (j1 : 0 < J <= 0.742) by (unfold J; split; [apply Rinv_0_lt_compat; lra | apply Rmult_le_reg_l with (1 + E); [lra | rewrite Rinv_r; lra]]).
unfold turn_fl; set (e := tail_fl q2 far s) in *; cbv zeta; set (inv := inverse_fl e) in *; assert (small := eta_small); assert (l := least_small).
assert (flat : (1 + z) * E <= 1).
  assert (H := exp_ineq1_le z); assert (inv_e : exp z * E = 1) by (unfold E; rewrite <- exp_plus, Rplus_opp_r; apply exp_0).
  rewrite <- inv_e; apply Rmult_le_compat_r; lra.
assert (eE : Rabs (e - E) <= 2.61 * u).
  unfold close in Tc; rewrite (Rabs_pos_eq E) in Tc by lra; apply Rle_trans with (1 := Tc).
  assert (0 <= z * E) by (apply Rmult_le_pos; lra); rewrite U; lra.
assert (c1 : Rabs (fl (1 - e) - (1 - E)) <= 3.3 * u).
  assert (a : Rabs (1 - e - (1 - E)) <= 2.61 * u) by (replace (_ - _) with (- (e - E)) by ring; rewrite Rabs_Ropp; exact eE).
  assert (b : Rabs (1 - E) <= 0.651) by (rewrite Rabs_pos_eq; lra).
  apply Rle_trans with (1 := fl_of _ _ _ _ a b); rewrite U; lra.
assert (pos : forall a A, 0 <= a <= A -> Rabs a <= A) by (intros; rewrite Rabs_pos_eq; lra).
assert (m2 := proj2 (square_near q2 R2 q2_range R2_range steep s s_range)); unfold z_fl in m2; fold z in m2.
assert (m3 : Rabs (fl (2 * fl (fl (q2 * s) * s)) - 2 * z) <= 6.4 * u).
  assert (a : Rabs (2 * fl (fl (q2 * s) * s) - 2 * z) <= 4.03 * u * z + 1e-200).
    rewrite <- Rmult_minus_distr_l, Rabs_mult, (Rabs_pos_eq 2) by lra; rewrite U in *; lra.
  apply Rle_trans with (1 := fl_of _ _ _ (2 * z) a ltac:(apply pos; lra)); rewrite U; lra.
assert (M := times_near _ _ _ _ _ _ 2.1 0.651 m3 c1 ltac:(apply pos; lra) ltac:(apply pos; lra)).
assert (v0 : 0 <= 2 * z * (1 - E) <= 2.1 * 0.651) by (apply small_product; lra).
assert (m4 := fl_of _ _ _ (2.1 * 0.651) M ltac:(apply pos; lra)); set (a := fl (fl (2 * fl (fl (q2 * s) * s)) * fl (1 - e))) in *.
assert (m5 : Rabs (a - 2 * z * (1 - E)) <= 12.7 * u) by (apply Rle_trans with (1 := m4); rewrite U; lra).
assert (iJ : Rabs (inv - J) <= 5.2 * u).
  unfold close in I; rewrite (Rabs_pos_eq J) in I by lra; apply Rle_trans with (1 := I); rewrite U; lra.
assert (N := times_near _ _ _ _ _ _ (2.1 * 0.651) 0.742 m5 iJ ltac:(apply pos; lra) ltac:(apply pos; lra)).
assert (is : 2 * z * (1 - E) * J = T) by (unfold T, turn; fold z; fold E; unfold J, z, Rdiv; ring); rewrite is in N.
apply Rle_trans with (1 := fl_of _ _ _ 1 N ltac:(apply pos; lra)); rewrite U; lra.
Qed.

(* Where the bracket is more than s, it is known well enough. *)
Hypothesis much : s < W * (1 - T).
Let b := 2 * W * (1 - T) - s.

Lemma excess_low y : 0 <= y <= 0.99 -> excess y <= -0.1.
Proof. intros [c d]; by_intervals y. Qed.

Lemma little_lost : W * (38.2 * u) <= 6.6e-13 * b /\ 19.1 * u <= 1 - T.
Proof.
assert (U := u_value); assert (r0 := sqrt_lt_R0 q2 (proj1 q2_range)); set (r := sqrt q2) in *; assert (W0 : 0 <= W) by (unfold W; lra).
assert (wt : 0 <= W * (1 - T)) by (apply Rmult_le_pos; lra).
destruct (Rle_lt_dec x 0.99) as [few | many].
  assert (x0 : 0 <= x) by (apply Rmult_le_pos; lra).
  assert (L := excess_low x ltac:(lra)); unfold x, r in L; rewrite excess_is in L by lra; fold T in L.
  assert (0.1 * W <= W * (1 - T)) by (rewrite (Rmult_comm 0.1); apply Rmult_le_compat_l; lra).
  unfold b; rewrite U; split; lra.
assert (Ws : W <= 151.6 * s).
  apply Rmult_le_reg_l with r; [exact r0 |]; unfold x, W in *; lra.
split; [unfold b; rewrite U; lra |].
destruct (Rle_lt_dec (19.1 * u) (1 - T)) as [le | lt]; [exact le | exfalso].
assert (W * (1 - T) <= W * (19.1 * u)) by (apply Rmult_le_compat_l; lra); rewrite U in *; lra.
Qed.

Lemma inner_low : let p := fl (fl (2 * fl (R2 - s)) * fl (1 - turn_fl q2 far s)) in (1 - 6.7e-13) * b - 1e3 * eta <= p - s.
Proof.
cbv zeta; assert (U := u_value); assert (n0 := eta_pos); assert (W0 : 0 <= W) by (unfold W; lra); destruct turn_below as [N T0]; destruct little_lost as [L T1].
assert (wt : 0 <= W * (1 - T)) by (apply Rmult_le_pos; lra); assert (small := eta_small); assert (l := least_small).
fold W; assert (Wl := fl_low W W0); set (Wf := fl W) in *; assert (Wf0 : 0 <= Wf) by (apply fl_nonneg; exact W0).
assert (d0 := fl_low (2 * Wf) ltac:(lra)); set (d := fl (2 * Wf)) in *; assert (d1 : 0 <= d) by (apply fl_nonneg; lra).
assert (dl : 2 * W - (4.01 * u * W + 4 * eta) <= d) by (rewrite U in *; lra).
assert (a : Rabs (1 - turn_fl q2 far s - (1 - T)) <= 18 * u) by (replace (_ - _) with (- (turn_fl q2 far s - T)) by ring; rewrite Rabs_Ropp; exact N).
assert (o := fl_of _ _ _ 1 a ltac:(rewrite Rabs_pos_eq; lra)); apply near in o; set (o' := fl (1 - turn_fl q2 far s)) in *.
assert (ol : 1 - T - 19.1 * u <= o') by (rewrite U in *; lra); assert (o0 : 0 <= o') by lra.
assert (P := product_low d o' (2 * W) (1 - T) (4.01 * u * W + 4 * eta) (19.1 * u) d1 o0 ltac:(lra) ltac:(lra) ltac:(rewrite U; lra) ltac:(rewrite U; lra) dl ltac:(lra)).
assert (q := fl_low (d * o') ltac:(apply Rmult_le_pos; assumption)); set (p := fl (d * o')) in *.
assert (et : eta * (1 - T) <= eta * 1) by (apply Rmult_le_compat_l; lra).
assert (bw : W * (1 - T) <= b) by (unfold b; lra); unfold b in *; rewrite U in *; lra.
Qed.

Lemma b_range : 0 < b <= 2e13.
Proof.
assert (W0 : 0 <= W <= 1e13) by (unfold W; lra); destruct turn_below as [_ T0]; assert (p := small_product W (1 - T) 1e13 1 ltac:(lra) ltac:(lra)); unfold b; lra.
Qed.

Lemma swell_some : (1 - 8e-13) * swell q1 q2 R2 s - 1e-255 <= Rmax 0 (swell_fl s).
Proof.
rewrite swell_is; fold b; assert (U := u_value); assert (n0 := eta_pos); assert (Z := z_below); assert (I := inner_low); cbv zeta in I; assert (b0 := b_range); assert (f0 := front_range).
assert (small := eta_small); assert (l := least_small); assert (t1 := tiny_is 1e30 ltac:(lra)); assert (s13 : 0 <= s <= 1e13) by lra.
assert (F := factor_close q1 q2 q1_range q2_range far s s13 ltac:(fold z; lra)); fold z in F; fold E in F; fold J in F; fold front in F.
unfold close in F; rewrite (Rabs_pos_eq front) in F by lra; apply near in F.
unfold swell_fl; set (p := fl (fl (2 * fl (R2 - s)) * fl (1 - turn_fl q2 far s))) in *; set (g := factor_fl q1 q2 (tail_fl q2 far s)) in *.
destruct (Rle_lt_dec 0 (p - s)) as [pos | neg].
  apply Rle_trans with (2 := Rmax_r _ _).
  assert (te := tail_nonneg q2 q2_range far far_nonneg s ltac:(lra)); assert (ie := inverse_nonneg _ te).
  assert (g0 : 0 <= g).
    assert (m : forall c d, 0 <= c -> 0 <= d -> 0 <= fl (c * d)) by (intros; apply fl_nonneg, Rmult_le_pos; assumption).
    unfold g, factor_fl; repeat (apply m; try assumption); lra.
  assert (rate : (2.13 * z + 21.9) * u * front <= 25 * u * front) by (apply Rmult_le_compat_r; [lra | apply Rmult_le_compat_r; [rewrite U |]; lra]).
  assert (h0 := fl_low (2 * g) ltac:(lra)); set (h := fl (2 * g)) in *; assert (h1 : 0 <= h) by (apply fl_nonneg; lra).
  assert (hl : 2 * front - (60 * u * front + 3e16 * eta) <= h) by (rewrite U in *; lra).
  assert (c0 := fl_low (p - s) pos); set (c := fl (p - s)) in *; assert (c1 : 0 <= c) by (apply fl_nonneg; lra).
  assert (cl : b - (6.8e-13 * b + 1e4 * eta) <= c) by (rewrite U in *; lra).
  assert (P := product_low h c (2 * front) b (60 * u * front + 3e16 * eta) (6.8e-13 * b + 1e4 * eta) h1 c1 ltac:(lra) ltac:(lra) ltac:(rewrite U; lra) ltac:(lra) hl cl).
  assert (Q := fl_low (h * c) ltac:(apply Rmult_le_pos; assumption)).
  assert (fb : 0 <= front * b) by (apply Rmult_le_pos; lra); assert (e1 : eta * b <= eta * 2e13) by (apply Rmult_le_compat_l; lra).
  assert (e2 : eta * front <= eta * 8e15) by (apply Rmult_le_compat_l; lra); rewrite U in *; lra.
apply Rle_trans with (2 := Rmax_l _ _).
assert (bs : b <= 2e3 * eta) by lra; assert (front * b <= 8e15 * (2e3 * eta)) by (apply Rmult_le_compat; lra).
assert (0 <= front * b) by (apply Rmult_le_pos; lra); lra.
Qed.
End Below.

Theorem swell_low : swell q1 q2 R2 s <= curvature.K q1 q2 R2 s \/ (1 - 8e-13) * swell q1 q2 R2 s - 1e-255 <= Rmax 0 (swell_fl s).
Proof.
assert (f0 := front_range); assert (W0 : 0 <= W) by (unfold W; lra); assert (K0 := K_nonneg q1 q2 R2 q1_range q2_range s s_range).
destruct (Rle_lt_dec 1 T) as [up | below].
  left; apply Rle_trans with (2 := K0); rewrite swell_is; assert (0 <= W * (T - 1)) by (apply Rmult_le_pos; lra).
  assert (0 <= front * - (2 * W * (1 - T) - s)) by (apply Rmult_le_pos; lra); lra.
destruct (Rle_lt_dec (W * (1 - T)) s) as [few | much]; [left | right; exact (swell_some below much)].
rewrite swell_is, (K_is q1 q2 R2 q1_range q2_range s); fold T z E; fold J; fold front; rewrite (Rmax_left 0 (T - 1)) by lra.
rewrite Rmult_0_r, Rplus_0_r; apply Rmult_le_compat_l; lra.
Qed.
End Swell.
