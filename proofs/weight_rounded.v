(* The error of one link weight (crates/core/src/equations/link.rs).

   In words. For a slack s = R^2 - D as it is stored, 0 < q1 <= 4 and q2 s^2 <= 690, the weight (q1/2) (1 - e) (1/(1 + e)) as the code
   computes it, with e from its own exponential and every operation rounded, is wrong by at most 3.2e-15 (`weight_error`). What lies beyond, and the
   error that s has itself, are in link_rounded.v. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Interval Require Import Tactic.
From Closeranks Require Import intervals weights rounding exponential.
Import ExactIntervals.
Local Open Scope R_scope.

Section Weight.
Variables q1 q2 s : R.
Hypothesis q1_range : 0 < q1 <= 4.
Hypothesis q2_pos : 0 < q2.
Hypothesis s_nonneg : 0 <= s.
Hypothesis in_range : q2 * (s * s) <= 690.
Definition exponent_fl := fl (fl (- q2 * s) * s).
Definition weight_fl e := fl (fl (fl (q1 / 2) * fl (1 - e)) * fl (1 / fl (1 + e))).
Let z := q2 * (s * s).

Lemma z_nonneg : 0 <= z. Proof. unfold z; apply Rmult_le_pos; [lra | apply Rmult_le_pos; lra]. Qed.

(* The first product is not so small that what rounds away could matter: times s it is at most 1e-20. *)
Hypothesis s_small : s <= 1e270.

Lemma exponent_error : Rabs (exponent_fl - - z) <= 2.1 * u * z + 1e-29.
Proof.
assert (Z := z_nonneg); assert (U := u_pos); assert (U1 := u_value); assert (E := eta_pos).
assert (F := fl_error (- q2 * s)); set (a := fl (- q2 * s)) in *.
assert (small : eta * s <= 1e-30).
  assert (H := eta_small); assert (least * 1e270 <= 1e-29).
    unfold least; replace 1e270 with (IZR (10 ^ 270)) by (unfold IPR, IPR_2; simpl; lra).
    apply Rmult_le_reg_l with (IZR (10 ^ 300)); [apply IZR_lt; reflexivity |].
    rewrite <- Rmult_assoc, Rinv_r, Rmult_1_l by (apply not_0_IZR; discriminate).
    replace (IZR (10 ^ 300)) with (IZR (10 ^ 270) * IZR (10 ^ 30)) by (rewrite <- mult_IZR; f_equal; reflexivity).
    assert (0 < IZR (10 ^ 270)) by (apply IZR_lt; reflexivity).
    simpl (10 ^ 30)%Z; nra.
  assert (0 < least) by (unfold least; apply Rinv_0_lt_compat, IZR_lt; reflexivity).
  assert (eta * s <= least / 1000000 * 1e270) by (apply Rmult_le_compat; lra); lra.
assert (P : Rabs (- q2 * s) = q2 * s) by (rewrite Rabs_left1; [ring | assert (0 <= q2 * s) by (apply Rmult_le_pos; lra); lra]).
rewrite P in F.
assert (step : Rabs (a * s - - z) <= u * z + 1e-30).
  replace (a * s - - z) with ((a - - q2 * s) * s) by (unfold z; ring); rewrite Rabs_mult, (Rabs_pos_eq s) by lra.
  assert (H := Rmult_le_compat_r s _ _ s_nonneg F); unfold z; lra.
assert (zz : Rabs (- z) <= z) by (rewrite Rabs_Ropp, Rabs_pos_eq; lra).
assert (G := fl_of _ _ _ _ step zz); unfold exponent_fl; fold a; assert (T := eta_small).
assert (least <= 1e-24).
  unfold least; assert (/ IZR (10 ^ 300) <= / IZR (10 ^ 24)) by (apply Rinv_le_contravar; [apply IZR_lt; reflexivity | apply IZR_le; vm_compute; discriminate]).
  simpl (10 ^ 24)%Z in *; lra.
rewrite U1 in *; lra.
Qed.

(* z e^-z is at most 1/e. *)
Lemma falls_fast : z * exp (- z) <= 0.37.
Proof.
assert (Z := z_nonneg); apply Rmult_le_reg_r with (exp z); [apply exp_pos |].
rewrite Rmult_assoc, <- exp_plus, Rplus_opp_l, exp_0, Rmult_1_r.
assert (H := exp_ineq1_le (z - 1)).
assert (split : exp z = exp 1 * exp (z - 1)) by (rewrite <- exp_plus; f_equal; ring).
rewrite split; assert (2.71 <= exp 1) by interval with (i_prec 60).
assert (0 < exp (z - 1)) by apply exp_pos; nra.
Qed.

Theorem tail_of_weight : Rabs (exp_fl exponent_fl - exp (- z)) <= 3.7e-16.
Proof.
assert (Z := z_nonneg); assert (X := exponent_error); assert (U := u_value); set (x := exponent_fl) in *.
assert (d0 : Rabs (x - - z) <= 2e-13) by (apply Rle_trans with (1 := X); rewrite U; unfold z in *; lra).
assert (d1 := near _ _ _ X); assert (d2 := near _ _ _ d0).
assert (x700 : -700 <= x <= 700) by (unfold z in *; lra).
assert (E := exp_error x x700).
set (d := x - - z) in *; assert (xd : x = - z + d) by (unfold d; ring); rewrite xd, exp_plus in E.
assert (D : Rabs d <= 2e-13) by exact d0.
assert (ed : Rabs (exp d - 1) <= 1.01 * Rabs d).
  destruct (Req_dec d 0) as [-> | ne]; [rewrite exp_0, Rminus_diag_eq, Rabs_R0 by lra; lra |].
  apply Rabs_le_inv in D; assert (low := exp_ineq1_le d); assert (high := exp_ineq1_le (- d)).
  assert (inv : exp d * exp (- d) = 1) by (rewrite <- exp_plus, Rplus_opp_r; apply exp_0).
  assert (pos := exp_pos d); assert (up : exp d * (1 - d) <= 1) by nra.
  assert (cap : exp d <= 1.001) by nra.
  destruct (Rle_lt_dec 0 d); [rewrite !Rabs_pos_eq by lra; nra | rewrite !Rabs_left by nra; nra].
assert (e0 := exp_pos (- z)); assert (fast := falls_fast).
assert (e1 : exp (- z) <= 1) by (rewrite <- exp_0; destruct (Req_dec z 0) as [-> | ne]; [rewrite Ropp_0; lra | apply Rlt_le, exp_increasing; lra]).
assert (part : exp (- z) * Rabs d <= 2.1 * u * 0.37 + 1e-29).
  apply Rle_trans with (exp (- z) * (2.1 * u * z + 1e-29)); [apply Rmult_le_compat_l; [lra | exact X] |].
  rewrite U; nra.
assert (move : Rabs (exp (- z) * exp d - exp (- z)) <= 1.01 * (exp (- z) * Rabs d)).
  replace (exp (- z) * exp d - exp (- z)) with (exp (- z) * (exp d - 1)) by ring; rewrite Rabs_mult, (Rabs_pos_eq (exp (- z))) by lra.
  assert (H := Rmult_le_compat_l _ _ _ (Rlt_le _ _ e0) ed); lra.
assert (size : exp (- z) * exp d <= 1.001).
  apply near in move; rewrite U in part; lra.
fold x; rewrite <- xd in *; apply near in E; apply near in move; rewrite U in *; apply Rabs_le; lra.
Qed.

Theorem weight_error : Rabs (weight_fl (exp_fl exponent_fl) - rise q1 q2 s) <= 3.2e-15.
Proof.
assert (T := tail_of_weight); set (e := exp_fl exponent_fl) in *; assert (Z := z_nonneg).
unfold rise; fold z; set (E := exp (- z)) in *.
assert (E0 : 0 < E) by apply exp_pos.
assert (E1 : E <= 1) by (unfold E; rewrite <- exp_0; destruct (Req_dec z 0) as [-> | ne]; [rewrite Ropp_0; lra | apply Rlt_le, exp_increasing; lra]).
apply near in T; assert (U := u_value).
assert (h0 : Rabs (q1 / 2) <= 2) by (apply Rabs_le; lra).
assert (h1 := fl_abs _ _ h0).
assert (m0 : Rabs (1 - e) <= 1.01) by (apply Rabs_le; lra).
assert (m1 := fl_abs _ _ m0); assert (m2 : Rabs (fl (1 - e) - (1 - E)) <= 4.9e-16) by (rewrite U in m1; apply near in m1; apply Rabs_le; lra).
assert (m3 : Rabs (fl (1 - e)) <= 1.01) by (apply near in m2; apply Rabs_le; lra).
assert (p := times _ _ _ _ _ _ _ _ h0 m3 h1 m2); set (a := fl (fl (q1 / 2) * fl (1 - e))) in *.
assert (a1 : Rabs (a - q1 / 2 * (1 - E)) <= 1.45e-15) by (apply Rle_trans with (1 := p); rewrite U; lra).
assert (s0 : Rabs (1 + e) <= 2.01) by (apply Rabs_le; lra).
assert (s1 := fl_abs _ _ s0); set (b := fl (1 + e)) in *.
assert (b1 : Rabs (b - (1 + E)) <= 6e-16) by (rewrite U in s1; apply near in s1; apply Rabs_le; lra).
apply near in b1.
assert (i0 : 0 < / b <= 1.001) by (split; [apply Rinv_0_lt_compat; lra | apply Rmult_le_reg_l with b; [lra | rewrite Rinv_r; lra]]).
assert (j0 : 0 < / (1 + E) <= 1) by (split; [apply Rinv_0_lt_compat; lra | apply Rmult_le_reg_l with (1 + E); [lra | rewrite Rinv_r; lra]]).
assert (i1 : Rabs (1 / b) <= 1.001) by (apply Rabs_le; lra).
assert (f := fl_abs _ _ i1); set (c := fl (1 / b)) in *.
assert (bj : Rabs (1 / b - / (1 + E)) <= 6e-16 * 1.001).
  replace (1 / b - / (1 + E)) with ((1 + E - b) * (/ b * / (1 + E))) by (field; lra).
  apply product; [apply Rabs_le; lra | rewrite Rabs_mult, !Rabs_pos_eq by lra].
  apply Rle_trans with (1.001 * 1); [apply Rmult_le_compat; lra | lra].
assert (c1 : Rabs (c - / (1 + E)) <= 7.2e-16) by (rewrite U in f; apply near in f; apply near in bj; apply Rabs_le; lra).
assert (goal : q1 / (1 + E) - q1 / 2 = q1 / 2 * (1 - E) * / (1 + E)) by (field; lra).
rewrite goal; unfold weight_fl; fold a b c.
assert (A : Rabs (q1 / 2 * (1 - E)) <= 2) by (apply Rle_trans with (2 * 1); [apply product; apply Rabs_le; lra | lra]).
assert (C : Rabs c <= 1.001) by (apply near in c1; apply Rabs_le; lra).
assert (q := times _ _ _ _ _ _ _ _ A C a1 c1).
apply Rle_trans with (1 := q); rewrite U; lra.
Qed.
End Weight.
