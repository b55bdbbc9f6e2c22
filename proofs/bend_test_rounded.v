(* The test that the peak of K is halved with, in doubles (crates/core/src/controller/budget/curvature.rs: `rises`).

   In words. Every operation is rounded. 0 < q2 <= 1e15, R^2 as it is stored is at most 1e13, and sqrt(q2) R^2 <= 151. With x = sqrt(q2) s and gap as in
   bend_gap.v:

   `test_near`: for 1.02 <= x <= 1.65, where the test says yes gap(x) is at least - 1e-10, and where it says no gap(x) is at most 1e-10.
   `test_far`: for x >= 1.62 the test says no.

   What the exponential does below -700 is left open (`far`), but for its being from 0 to 0.05; the code gives at most 1e-300. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Interval Require Import Tactic.
From Closeranks Require Import intervals weights curvature peak bend_peak rounding exponential weight_rounded link_rounded slope_rounded slope_max_rounded bend_gap.
Import ExactIntervals.
Local Open Scope R_scope.

(* One rounded operation, roughly. *)
Lemma rounded x y d s t : Rabs (x - y) <= d -> Rabs y <= s -> d <= 1 -> 1.01 * d + 1.12e-16 * s + 1e-29 <= t -> Rabs (fl x - y) <= t.
Proof.
intros D S d1 enough; assert (F := fl_of _ _ _ _ D S); assert (U := u_value); assert (n := eta_small); assert (l := least_small).
assert (d0 := Rle_trans _ _ _ (Rabs_pos _) D); assert (s0 := Rle_trans _ _ _ (Rabs_pos _) S).
apply Rle_trans with (1 := F); rewrite U; lra.
Qed.
Lemma times_near a A da b B db MA MB : Rabs (a - A) <= da -> Rabs (b - B) <= db -> Rabs A <= MA -> Rabs B <= MB ->
  Rabs (a * b - A * B) <= MA * db + MB * da + da * db.
Proof.
intros Ha Hb HA HB; replace (a * b - A * B) with (A * (b - B) + B * (a - A) + (a - A) * (b - B)) by ring.
assert (p : forall c d C D, Rabs c <= C -> Rabs d <= D -> Rabs (c * d) <= C * D).
  intros c d C D hc hd; rewrite Rabs_mult; apply Rmult_le_compat; try apply Rabs_pos; assumption.
apply Rle_trans with (1 := Rabs_triang _ _), Rplus_le_compat; [| apply p; assumption].
apply Rle_trans with (1 := Rabs_triang _ _), Rplus_le_compat; apply p; assumption.
Qed.
(* And of what is not tiny. *)
Lemma fl_both x : 1e-20 <= x -> 0.9999 * x <= fl x <= 1.0001 * x.
Proof.
intro x0; assert (F := fl_error x); assert (U := u_value); assert (n := eta_small); assert (l := least_small).
rewrite (Rabs_pos_eq x) in F by lra; apply near in F; rewrite U in F; lra.
Qed.
Lemma fl_below_1 x : x <= 1 -> fl x <= 1.
Proof. intro le; apply Rle_trans with (fl 1); [apply fl_mono; exact le | apply Req_le; exact (fl_whole 1 eq_refl)]. Qed.
Lemma fl_above_1 x : 1 <= x -> 1 <= fl x.
Proof. intro le; apply Rle_trans with (fl 1); [apply Req_le; symmetry; exact (fl_whole 1 eq_refl) | apply fl_mono; exact le]. Qed.

Section Test.
Variables q2 R2 : R.
Hypothesis q2_range : 0 < q2 <= 1e15.
Hypothesis R2_range : 0 <= R2 <= 1e13.
Hypothesis steep : sqrt q2 * R2 <= 151.
Variable far : R -> R.
Hypothesis far_range : forall x, 0 <= far x <= 0.05.

Definition z_fl s := fl (fl (q2 * s) * s).
Definition tanh_fl s := let e := exp_code far (- z_fl s) in fl (fl (1 - e) / fl (1 + e)).
Definition excess_fl s := fl (fl (fl (2 * z_fl s) * tanh_fl s) - 1).
Definition bracket_fl s := let h := tanh_fl s in
  fl (fl (4 * fl (h + fl (fl (/ 2 * z_fl s) * fl (1 - fl (h * h))))) - fl (fl (2 * h) * excess_fl s)).
Definition ahead_fl s := fl (fl (fl (2 * fl (R2 - s)) * q2) * s).
Definition rises_fl s := fl (3 * excess_fl s) < fl (ahead_fl s * bracket_fl s).

Variable s : R.
Hypothesis s_range : 0 <= s <= R2.
Let r := sqrt q2.
Let x := r * s.
Let X := r * R2.
Let z := q2 * (s * s).

Lemma xx : x * x = z. Proof. apply square_is; lra. Qed.
Lemma x_X : 0 <= x <= X.
Proof. assert (r0 := sqrt_pos q2); fold r in r0; split; [apply Rmult_le_pos | apply Rmult_le_compat_l]; lra. Qed.

Lemma tail_same : exp_code far (- z_fl s) = tail_fl q2 far s.
Proof.
unfold tail_fl, exponent_fl, z_fl; f_equal; rewrite Ropp_mult_distr_l_reverse; unfold fl.
rewrite (round_NE_opp radix2 (FLT_exp (-1074) 53) (q2 * s)), Ropp_mult_distr_l_reverse, round_NE_opp; reflexivity.
Qed.

Lemma square_near : z <= 22801 /\ Rabs (z_fl s - z) <= 2.01 * u * z + 1e-250.
Proof.
assert (n0 := eta_pos); assert (pos : forall a A, 0 <= a <= A -> Rabs a <= A) by (intros; rewrite Rabs_pos_eq; lra).
assert (z1 : 0 <= z <= 22801).
  assert (b := x_X); rewrite <- xx; split; [apply Rmult_le_pos; lra |].
  apply Rle_trans with (151 * 151); [apply Rmult_le_compat; unfold X, r in *; lra | lra].
split; [lra |].
assert (b1 := small_product q2 s 1e15 1e13 ltac:(lra) ltac:(lra)).
assert (m1 : close (fl (q2 * s)) (q2 * s) 1.001 eta).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ 1e15 1e13 (same q2) (same s) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
assert (m2 : close (fl (fl (q2 * s) * s)) (q2 * s * s) 2.002 (2e13 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ (1e15 * 1e13) 1e13 m1 (same s) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
unfold close in m2; replace (q2 * s * s) with z in m2 by (unfold z; ring); rewrite (Rabs_pos_eq z) in m2 by lra.
assert (T := tiny_is 2e13 ltac:(lra)); apply Rle_trans with (1 := m2); assert (U := u_value); rewrite U; lra.
Qed.

Lemma ahead_near : close (ahead_fl s) (2 * (X - x) * x) 4.2 1e-200.
Proof.
assert (n0 := eta_pos); assert (pos : forall a A, 0 <= a <= A -> Rabs a <= A) by (intros; rewrite Rabs_pos_eq; lra).
assert (b0 : 0 <= R2 - s <= 1e13) by lra.
assert (m0 : close (fl (R2 - s)) (R2 - s) 1 eta) by (unfold close; assert (F := fl_error (R2 - s)); lra).
assert (m1 : close (fl (2 * fl (R2 - s))) (2 * (R2 - s)) 2.001 (4 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ 2 1e13 (same 2) m0 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
assert (b1 := small_product (2 * (R2 - s)) q2 2e13 1e15 ltac:(lra) ltac:(lra)).
assert (m2 : close (fl (fl (2 * fl (R2 - s)) * q2)) (2 * (R2 - s) * q2) 3.002 (1e16 * eta)).
  apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ 2e13 1e15 m1 (same q2) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
assert (T := tiny_is 1e30 ltac:(lra)).
assert (is : 2 * (X - x) * x = 2 * (R2 - s) * q2 * s) by (unfold X, x; rewrite <- (root_square q2) by lra; fold r; ring); rewrite is.
apply (weaker _ _ _ _ _ _ (mul _ _ _ _ _ _ _ _ (2e13 * 1e15) 1e13 m2 (same s) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(apply pos; lra) ltac:(apply pos; lra))); lra.
Qed.

Section Near.
Hypothesis x_range : 1.02 <= x <= 1.65.

Lemma z_small : 1.04 <= z <= 2.73.
Proof.
rewrite <- xx; split; [apply Rle_trans with (1.02 * 1.02) | apply Rle_trans with (1.65 * 1.65)]; try lra; apply Rmult_le_compat; lra.
Qed.

Lemma tanh_near : Rabs (tanh_fl s - tanh_half x) <= 1.8e-15 /\ 0.47 <= tanh_half x <= 0.88.
Proof.
assert (Z := z_small); assert (T := tail_abs q2 q2_range far s ltac:(lra) ltac:(fold z; lra)); fold z in T.
unfold tanh_fl, tanh_half; rewrite tail_same, xx; cbv zeta; set (e := tail_fl q2 far s) in *; set (E := exp (- z)) in *.
assert (E1 : 0.065 <= E <= 0.36) by (unfold E; split; interval with (i_prec 60)).
assert (a1 : Rabs (fl (1 - e) - (1 - E)) <= 6e-16).
  apply (rounded _ _ 3.7e-16 0.94); [replace (1 - e - (1 - E)) with (- (e - E)) by ring; rewrite Rabs_Ropp; exact T | rewrite Rabs_pos_eq; lra | lra | lra].
assert (b1 : Rabs (fl (1 + e) - (1 + E)) <= 6e-16).
  apply (rounded _ _ 3.7e-16 1.36); [replace (1 + e - (1 + E)) with (e - E) by ring; exact T | rewrite Rabs_pos_eq; lra | lra | lra].
set (a := fl (1 - e)) in *; set (b := fl (1 + e)) in *; assert (a2 := near _ _ _ a1); assert (b2 := near _ _ _ b1).
assert (h : 0.47 <= (1 - E) / (1 + E) <= 0.88).
  unfold Rdiv; split; apply Rmult_le_reg_r with (1 + E); try lra; rewrite Rmult_assoc, Rinv_l by lra; lra.
split; [| exact h]; apply (rounded _ _ 1.5e-15 0.88); [| rewrite Rabs_pos_eq; lra | lra | lra].
replace (a / b - (1 - E) / (1 + E)) with (((a - (1 - E)) * (1 + E) - (1 - E) * (b - (1 + E))) * (/ b * / (1 + E))) by (field; lra).
assert (i0 : 0 < / b <= 1.001) by (split; [apply Rinv_0_lt_compat; lra | apply Rmult_le_reg_l with b; [lra | rewrite Rinv_r; lra]]).
assert (j0 : 0 < / (1 + E) <= 1) by (split; [apply Rinv_0_lt_compat; lra | apply Rmult_le_reg_l with (1 + E); [lra | rewrite Rinv_r; lra]]).
assert (ij : 0 <= / b * / (1 + E) <= 1.001 * 1) by (split; [apply Rmult_le_pos | apply Rmult_le_compat]; lra).
rewrite Rabs_mult, (Rabs_pos_eq (/ b * _)) by lra.
assert (n1 : Rabs ((a - (1 - E)) * (1 + E) - (1 - E) * (b - (1 + E))) <= 1.4e-15).
  assert (p1 : Rabs ((a - (1 - E)) * (1 + E)) <= 6e-16 * 1.36).
    rewrite Rabs_mult; apply Rmult_le_compat; try apply Rabs_pos; [exact a1 | rewrite Rabs_pos_eq; lra].
  assert (p2 : Rabs ((1 - E) * (b - (1 + E))) <= 0.94 * 6e-16).
    rewrite Rabs_mult; apply Rmult_le_compat; try apply Rabs_pos; [rewrite Rabs_pos_eq; lra | exact b1].
  apply Rabs_le_inv in p1; apply Rabs_le_inv in p2; apply Rabs_le; lra.
apply Rle_trans with (1.4e-15 * (1.001 * 1)); [apply Rmult_le_compat; [apply Rabs_pos | | |]; lra | lra].
Qed.

Lemma excess_near : Rabs (excess_fl s - excess x) <= 1.5e-14 /\ Rabs (excess x) <= 3.9.
Proof.
assert (Z := z_small); destruct square_near as [_ Q]; destruct tanh_near as [T h]; assert (U := u_value).
unfold excess_fl, excess; rewrite xx; set (t := tanh_half x) in *; set (q := z_fl s) in *; set (tf := tanh_fl s) in *.
assert (q0 : Rabs (q - z) <= 7e-16) by (apply Rle_trans with (1 := Q); rewrite U; lra).
assert (q1 : Rabs (fl (2 * q) - 2 * z) <= 3e-15).
  apply (rounded _ _ 1.4e-15 5.5); [replace (2 * q - 2 * z) with (2 * (q - z)) by ring; rewrite Rabs_mult, (Rabs_pos_eq 2) by lra; lra | rewrite Rabs_pos_eq; lra | lra | lra].
assert (M := times_near _ _ _ _ _ _ 5.5 0.88 q1 T ltac:(rewrite Rabs_pos_eq; lra) ltac:(rewrite Rabs_pos_eq; lra)).
assert (zt : 0 <= z * t <= 2.73 * 0.88) by (split; [apply Rmult_le_pos | apply Rmult_le_compat]; lra).
assert (m1 : Rabs (fl (fl (2 * q) * tf) - 2 * z * t) <= 1.4e-14) by (apply (rounded _ _ _ 4.9 _ M); [rewrite Rabs_pos_eq | |]; lra).
assert (small : Rabs (2 * z * t - 1) <= 3.9) by (apply Rabs_le; lra).
split; [apply (rounded _ _ 1.4e-14 3.9); [| exact small | lra | lra] | exact small].
replace (fl (fl (2 * q) * tf) - 1 - (2 * z * t - 1)) with (fl (fl (2 * q) * tf) - 2 * z * t) by ring; exact m1.
Qed.

Lemma bracket_near : Rabs (bracket_fl s - bracket x) <= 8.5e-14 /\ Rabs (bracket x) <= 4.
Proof.
assert (Z := z_small); destruct square_near as [_ Q]; destruct tanh_near as [T h]; destruct excess_near as [E small]; assert (U := u_value).
assert (P := push_range x x_range); assert (top : Rabs (bracket x) <= 4).
  unfold push in P; apply Rabs_le; split; apply Rmult_le_reg_l with x; lra.
split; [| exact top].
unfold bracket_fl; cbv zeta; set (tf := tanh_fl s) in *; set (q := z_fl s) in *; set (ef := excess_fl s) in *.
unfold bracket in *; rewrite xx in *; set (t := tanh_half x) in *; set (w := excess x) in *.
assert (q0 : Rabs (q - z) <= 7e-16) by (apply Rle_trans with (1 := Q); rewrite U; lra).
assert (h1 : Rabs (fl (/ 2 * q) - z / 2) <= 6e-16).
  apply (rounded _ _ 3.5e-16 1.4); [replace (/ 2 * q - z / 2) with (/ 2 * (q - z)) by field; rewrite Rabs_mult, (Rabs_pos_eq (/ 2)) by lra; lra | rewrite Rabs_pos_eq; lra | lra | lra].
assert (tp : Rabs t <= 0.88) by (rewrite Rabs_pos_eq; lra).
assert (tt : 0.47 * 0.47 <= t * t <= 0.88 * 0.88) by (split; apply Rmult_le_compat; lra).
assert (s1 : Rabs (fl (tf * tf) - t * t) <= 3.4e-15).
  assert (M := times_near _ _ _ _ _ _ _ _ T T tp tp); apply (rounded _ _ _ 0.78 _ M); [rewrite Rabs_pos_eq | |]; lra.
assert (s2 : Rabs (fl (1 - fl (tf * tf)) - (1 - t * t)) <= 3.6e-15).
  apply (rounded _ _ 3.4e-15 0.78); [replace (1 - fl (tf * tf) - (1 - t * t)) with (- (fl (tf * tf) - t * t)) by ring; rewrite Rabs_Ropp; exact s1 | rewrite Rabs_pos_eq; lra | lra | lra].
assert (c0 : 0 <= z / 2 * (1 - t * t) <= 1.4 * 0.78) by (split; [apply Rmult_le_pos | apply Rmult_le_compat]; lra).
assert (s3 : Rabs (fl (fl (/ 2 * q) * fl (1 - fl (tf * tf))) - z / 2 * (1 - t * t)) <= 5.9e-15).
  assert (M := times_near _ _ _ _ _ _ 1.4 0.78 h1 s2 ltac:(rewrite Rabs_pos_eq; lra) ltac:(rewrite Rabs_pos_eq; lra)).
  apply (rounded _ _ _ 1.1 _ M); [rewrite Rabs_pos_eq | |]; lra.
set (p := fl (fl (/ 2 * q) * fl (1 - fl (tf * tf)))) in *; set (c := z / 2 * (1 - t * t)) in *.
assert (s4 : Rabs (fl (tf + p) - (t + c)) <= 8.1e-15).
  apply (rounded _ _ 7.7e-15 2); [| rewrite Rabs_pos_eq; lra | lra | lra].
  replace (tf + p - (t + c)) with ((tf - t) + (p - c)) by ring; apply Rle_trans with (1 := Rabs_triang _ _); lra.
assert (s5 : Rabs (fl (4 * fl (tf + p)) - 4 * (t + c)) <= 3.4e-14).
  apply (rounded _ _ 3.24e-14 8); [| rewrite Rabs_pos_eq; lra | lra | lra].
  rewrite <- Rmult_minus_distr_l, Rabs_mult, (Rabs_pos_eq 4) by lra; lra.
assert (s6 : Rabs (fl (2 * tf) - 2 * t) <= 4e-15).
  apply (rounded _ _ 3.6e-15 1.76); [| rewrite Rabs_pos_eq; lra | lra | lra].
  rewrite <- Rmult_minus_distr_l, Rabs_mult, (Rabs_pos_eq 2) by lra; lra.
assert (s7 : Rabs (fl (fl (2 * tf) * ef) - 2 * t * w) <= 4.4e-14).
  assert (M := times_near _ _ _ _ _ _ 1.76 3.9 s6 E ltac:(rewrite Rabs_pos_eq; lra) small).
  apply (rounded _ _ _ 7 _ M); [| lra | lra]; rewrite Rabs_mult, (Rabs_pos_eq (2 * t)) by lra.
  apply Rle_trans with (1.76 * 3.9); [apply Rmult_le_compat; try apply Rabs_pos; lra | lra].
apply (rounded _ _ 7.8e-14 4); [| exact top | lra | lra].
replace (_ - _) with ((fl (4 * fl (tf + p)) - 4 * (t + c)) - (fl (fl (2 * tf) * ef) - 2 * t * w)) by ring.
apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_Ropp; lra.
Qed.

Theorem test_near : (rises_fl s -> - 1e-10 <= gap X x) /\ (~ rises_fl s -> gap X x <= 1e-10).
Proof.
destruct bracket_near as [B top]; destruct excess_near as [E small]; assert (A := ahead_near); assert (b := x_X); assert (U := u_value).
assert (X150 : X <= 151) by exact steep; assert (a0 : 0 <= 2 * (X - x) * x <= 500).
  split; [apply Rmult_le_pos; lra |]; apply Rle_trans with (2 * 151 * 1.65); [apply Rmult_le_compat; lra | lra].
unfold close in A; rewrite (Rabs_pos_eq (2 * (X - x) * x)) in A by lra.
assert (A' : Rabs (ahead_fl s - 2 * (X - x) * x) <= 2.4e-13) by (apply Rle_trans with (1 := A); rewrite U; lra).
assert (M := times_near _ _ _ _ _ _ 500 4 A' B ltac:(rewrite Rabs_pos_eq; lra) top).
assert (big : Rabs (2 * (X - x) * x * bracket x) <= 2000).
  rewrite Rabs_mult, (Rabs_pos_eq (2 * _ * _)) by lra; apply Rle_trans with (500 * 4); [apply Rmult_le_compat; try apply Rabs_pos; lra | lra].
assert (F := rounded _ _ _ _ 4.5e-11 M big ltac:(lra) ltac:(lra)).
assert (G : Rabs (fl (3 * excess_fl s) - 3 * excess x) <= 1e-13).
  apply (rounded _ _ 4.5e-14 11.7); [| rewrite Rabs_mult, (Rabs_pos_eq 3) by lra; lra | lra | lra].
  rewrite <- Rmult_minus_distr_l, Rabs_mult, (Rabs_pos_eq 3) by lra; lra.
assert (is : gap X x = 2 * (X - x) * x * bracket x - 3 * excess x) by (unfold gap, push; ring).
apply near in F; apply near in G; rewrite is; unfold rises_fl; split; intro; lra.
Qed.
End Near.

Theorem test_far : 1.62 <= x -> ~ rises_fl s.
Proof.
intro x1; destruct square_near as [z1 Q]; assert (U := u_value); assert (z0 : 2.62 <= z).
  rewrite <- xx; apply Rle_trans with (1.62 * 1.62); [lra | apply Rmult_le_compat; lra].
unfold rises_fl, bracket_fl, excess_fl, tanh_fl; set (q := z_fl s) in *; apply near in Q.
assert (q0 : 2.61 <= q) by (rewrite U in Q; lra); clear Q.
assert (mono : forall a c, 1e-20 <= c -> a <= c -> fl a <= 1.0001 * c).
  intros a c c0 ac; apply Rle_trans with (fl c); [apply fl_mono; exact ac | apply fl_both; exact c0].
set (e := exp_code far (- q)); assert (e1 : 0 <= e <= 0.074).
  unfold e, exp_code; destruct (Rle_dec _ _) as [in_range | _]; [| assert (H := far_range (- q)); lra].
  assert (F := exp_error (- q) ltac:(lra)); assert (p := exp_pos (- q)); apply near in F; rewrite U in F.
  assert (exp (- q) <= 0.0737); [| lra].
  apply Rle_trans with (exp (- (2.61))); [| interval with (i_prec 60)].
  destruct (Req_dec q 2.61) as [-> | ne]; [apply Rle_refl | apply Rlt_le, exp_increasing; lra].
cbv zeta; set (a := fl (1 - e)); set (b := fl (1 + e)).
assert (a1 : 0.9258 <= a <= 1).
  split; [assert (H := fl_both (1 - e) ltac:(lra)); unfold a; lra | apply fl_below_1; lra].
assert (b1 : 1 <= b <= 1.0742).
  split; [apply fl_above_1; lra | assert (H := fl_both (1 + e) ltac:(lra)); unfold b; lra].
set (h := fl (a / b)); assert (h1 : 0.8617 <= h <= 1).
  assert (low : 0.8618 <= a / b) by (apply Rmult_le_reg_r with b; [lra | unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra; lra]).
  assert (high : a / b <= 1) by (apply Rmult_le_reg_r with b; [lra | unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra; lra]).
  split; [assert (H := fl_both (a / b) ltac:(lra)); unfold h; lra | apply fl_below_1; exact high].
assert (h2 : 0.8617 * 0.8617 <= h * h <= 1 * 1) by (split; apply Rmult_le_compat; lra).
set (m := fl (2 * q)); assert (m1 : 1.9998 * q <= m) by (assert (H := fl_both (2 * q) ltac:(lra)); unfold m; lra).
assert (mh : m * 0.8617 <= m * h) by (apply Rmult_le_compat_l; lra).
set (n := fl (m * h)); assert (n1 : 1.7228 * q <= n) by (assert (H := fl_both (m * h) ltac:(lra)); unfold n; lra).
set (ex := fl (n - 1)); assert (ex1 : 1.7226 * q - 1 <= ex) by (assert (H := fl_both (n - 1) ltac:(lra)); unfold ex; lra).
set (p := fl (h * h)); assert (p1 : 0.742 <= p <= 1).
  split; [assert (H := fl_both (h * h) ltac:(lra)); unfold p; lra | apply fl_below_1; lra].
set (o := fl (1 - p)); assert (o1 : 0 <= o <= 0.2581) by (split; [apply fl_nonneg; lra | apply Rle_trans with (1.0001 * 0.258); [apply mono; lra | lra]]).
set (w := fl (/ 2 * q)); assert (w1 : 0 <= w <= 0.5001 * q) by (split; [apply fl_nonneg; lra | apply Rle_trans with (1.0001 * (/ 2 * q)); [apply mono; lra | lra]]).
assert (wo : 0 <= w * o <= 0.5001 * q * 0.2581) by (apply small_product; lra).
set (v := fl (w * o)); assert (v1 : v <= 0.1292 * q) by (apply Rle_trans with (1.0001 * (0.5001 * q * 0.2581)); [apply mono; lra | lra]).
assert (v0 : 0 <= v) by (apply fl_nonneg; lra).
set (y := fl (h + v)); assert (y1 : y <= 1.0001 + 0.1293 * q) by (apply Rle_trans with (1.0001 * (1 + 0.1292 * q)); [apply mono; lra | lra]).
set (four := fl (4 * y)); assert (four1 : four <= 4.001 + 0.518 * q) by (apply Rle_trans with (1.0001 * (4 * (1.0001 + 0.1293 * q))); [apply mono; lra | lra]).
set (d := fl (2 * h)); assert (d1 : 1.7232 <= d) by (assert (H := fl_both (2 * h) ltac:(lra)); unfold d; lra).
assert (de : 1.7232 * (1.7226 * q - 1) <= d * ex) by (apply Rmult_le_compat; lra).
assert (mm : 1.723 * (1.7226 * q - 1) <= fl (d * ex)) by (assert (H := fl_both (d * ex) ltac:(lra)); lra).
assert (neg : fl (four - fl (d * ex)) <= 0) by (rewrite <- fl_zero; apply fl_mono; lra).
assert (pos : 0 <= fl (3 * ex)) by (apply fl_nonneg; lra).
assert (front : 0 <= ahead_fl s).
  unfold ahead_fl; apply fl_nonneg, Rmult_le_pos; [apply fl_nonneg, Rmult_le_pos; [apply fl_nonneg, Rmult_le_pos; [lra | apply fl_nonneg; lra] | lra] | lra].
assert (prod : 0 <= ahead_fl s * - fl (four - fl (d * ex))) by (apply Rmult_le_pos; lra).
assert (low : fl (ahead_fl s * fl (four - fl (d * ex))) <= 0) by (rewrite <- fl_zero; apply fl_mono; lra).
lra.
Qed.
End Test.
