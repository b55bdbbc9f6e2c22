(* The weight of one link, from two positions to the last digit (crates/core/src/equations/link.rs: `link`, `weight_at`).

   In words. Positions are doubles, and from them on every operation is rounded: the offset, its squared length D in up to three dimensions, the
   slack s = R^2 - D, the exponent - q2 s^2, the exponential, and the weight. Let 0 < q1 <= 4, 0 < q2 <= 1e15 and 0 <= R <= 1e6: more than the
   settings allow. Then the computed weight is wrong by at most 3.3e-15 + 3.7e-16 q1 sqrt(q2) R^2 (`link_error`), also where one of the two,
   the real distance and the computed one, is within R and the other is not; a pair that is out of range has weight 0.

   `link_error_paper`: where q1 sqrt(q2) R^2 <= 18, this is at most 1e-14, which `level_error` asks for. With R = 3 m and q1 = 2.1 that is
   q2 <= 0.9 1/m^4.
   `link_error_chosen`: where q2 is at most what `budget` chooses for itself, (150/R^2)^2, also where that is rounded, it is at most 2.3e-13.

   The first part of the bound is what the weight is wrong by for the slack as it is stored. The second part is what the slack is wrong by, at
   most 9.2e-16 R^2 (`slack_error`), times the greatest slope of the weight (`slope_bound`). So steep weights are less exact.

   `shortcut`: for exponents from -700 to -40 the long way gives q1/2 to the last digit too, because 1 + e and 1 - e are 1 (`flat`). So the
   shortcut changes no bit. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Flocq Require Import Plus_error.
From Interval Require Import Tactic.
From Closeranks Require Import intervals weights rounding exponential weight_rounded.
Import ExactIntervals.
Local Open Scope R_scope.

Local Existing Instance prec_53.
Definition double t := generic_format radix2 (FLT_exp (-1074) 53) t.

Section Slack.
Variables (k : nat) (x y : nat -> R) (radius : R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis doubles : forall d, double (x d) /\ double (y d).
Hypothesis radius_range : 0 <= radius <= 1e6.
Let R2 := radius * radius.
Definition offset d := x d - y d.
Definition distance2 := dot offset offset k.
Definition offset_fl d := fl (x d - y d).
Definition distance2_fl := dot_fl offset_fl offset_fl k.
Definition slack_fl := fl (fl (radius * radius) - distance2_fl).

Lemma R2_range : 0 <= R2 <= 1e12.
Proof. unfold R2; split; [apply Rmult_le_pos; lra | apply Rle_trans with (1e6 * 1e6); [apply Rmult_le_compat; lra | lra]]. Qed.

Lemma distance2_nonneg : 0 <= distance2.
Proof. apply (square_nonneg k offset). Qed.

Lemma least_small : least <= 1e-40.
Proof.
unfold least; assert (/ IZR (10 ^ 300) <= / IZR (10 ^ 40)) by (apply Rinv_le_contravar; [apply IZR_lt; reflexivity | apply IZR_le; vm_compute; discriminate]).
simpl (10 ^ 40)%Z in *; lra.
Qed.

Lemma fl_zero : fl 0 = 0.
Proof. apply round_0, valid_rnd_N. Qed.
Lemma fl_mono a b : a <= b -> fl a <= fl b.
Proof. apply round_le; [apply FLT_exp_valid; reflexivity | apply valid_rnd_N]. Qed.

Lemma fl_double a : double (fl a).
Proof. apply generic_format_round; [apply FLT_exp_valid; reflexivity | apply valid_rnd_N]. Qed.
Lemma fl_twice a : fl (fl a) = fl a.
Proof. apply round_generic; [apply valid_rnd_N | apply fl_double]. Qed.

Lemma distance2_near : Rabs (distance2_fl - distance2) <= 8e-16 * distance2 + least.
Proof. exact (distance_error x y k k3 doubles). Qed.

(* Whoever is out of range for certain has a negative slack. *)
Lemma out_of_range : slack_fl >= 0 -> distance2 <= R2 * (1 + 1e-14) + 3 * least.
Proof.
intro in_range; assert (N := distance2_near); assert (P := distance2_nonneg); assert (r := R2_range).
assert (S := fl_error R2); assert (E := eta_pos); assert (small := eta_small); assert (U := u_value); rewrite (Rabs_pos_eq R2) in S by lra.
assert (cmp : distance2_fl <= fl R2).
  destruct (Rle_lt_dec distance2_fl (fl R2)) as [le | lt]; [exact le | exfalso].
  assert (strict : fl (fl R2 - distance2_fl) < 0); [| unfold slack_fl in in_range; fold R2 in in_range; lra].
  assert (F1 : double (fl R2)) by apply fl_double.
  assert (F2 : double distance2_fl).
    unfold distance2_fl; destruct k as [| j]; [apply generic_format_0 |].
    cbn [dot_fl]; apply fl_double.
  assert (ne : fl (fl R2 - distance2_fl) <> 0).
    apply (round_plus_neq_0 radix2 (FLT_exp (-1074) 53) ZnearestE (fl R2) (- distance2_fl) F1); [apply generic_format_opp; exact F2 | intro zero; lra].
  assert (le : fl (fl R2 - distance2_fl) <= fl 0) by (apply fl_mono; lra).
  rewrite fl_zero in le; lra.
apply near in N; apply near in S; rewrite U in *; lra.
Qed.

Theorem slack_error : distance2 <= R2 * (1 + 1e-14) + 3 * least -> Rabs (slack_fl - (R2 - distance2)) <= 9.2e-16 * R2 + 3 * least.
Proof.
intro few; assert (N := distance2_near); assert (P := distance2_nonneg); assert (r := R2_range).
assert (S := fl_error R2); assert (E := eta_pos); assert (small := eta_small); assert (U := u_value); rewrite (Rabs_pos_eq R2) in S by lra.
assert (L := least_small); set (gap := fl R2 - distance2_fl).
assert (G : Rabs (gap - (R2 - distance2)) <= u * R2 + 8e-16 * distance2 + 1.1 * least).
  unfold gap; replace (_ - _) with ((fl R2 - R2) - (distance2_fl - distance2)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _); rewrite Rabs_Ropp; lra.
assert (size : Rabs (R2 - distance2) <= R2 - distance2 + 2 * (R2 * 1e-14 + 3 * least)) by (apply Rabs_le; lra).
unfold slack_fl; fold R2 gap; apply Rle_trans with (1 := fl_of _ _ _ _ G size); rewrite U in *; lra.
Qed.
End Slack.

(* What is rounded to 1. *)
Lemma fl_one t : Rabs (t - 1) < / 2 ^ 54 -> fl t = 1.
Proof.
intro H; apply Rabs_def2 in H; assert (F : double 1).
  rewrite <- (fl_whole 1) by reflexivity; apply fl_double.
assert (above : succ radix2 (FLT_exp (-1074) 53) 1 = 1 + / 2 ^ 52).
  rewrite succ_eq_pos by lra; replace 1 with (bpow radix2 0) at 2 by reflexivity; rewrite ulp_bpow; simpl; lra.
assert (beneath : pred radix2 (FLT_exp (-1074) 53) 1 = 1 - / 2 ^ 53).
  replace 1 with (bpow radix2 0) at 1 by reflexivity; rewrite pred_bpow; simpl; lra.
apply Rle_antisym.
  apply (round_N_le_midp radix2 (FLT_exp (-1074) 53)); [exact F | rewrite above; lra].
apply (round_N_ge_midp radix2 (FLT_exp (-1074) 53)); [exact F | rewrite beneath; lra].
Qed.

Section Weight.
Variables q1 q2 : R.
Hypothesis q1_range : 0 < q1 <= 4.
Hypothesis q2_range : 0 < q2 <= 1e15.

Theorem flat e : 0 <= e < / 2 ^ 54 -> weight_fl q1 e = fl (q1 / 2).
Proof.
intro small; unfold weight_fl; rewrite (fl_one (1 - e)) by (apply Rabs_def1; lra).
rewrite (fl_one (1 + e)) by (apply Rabs_def1; lra).
replace (1 / 1) with 1 by field; rewrite (fl_one 1) by (rewrite Rminus_diag_eq, Rabs_R0; lra).
rewrite !Rmult_1_r, !fl_twice; reflexivity.
Qed.

Theorem shortcut x : -700 <= x < -40 -> weight_fl q1 (exp_fl x) = fl (q1 / 2).
Proof.
intro far; apply flat; assert (E := exp_error x ltac:(lra)); assert (e0 := exp_pos x); assert (U := u_value).
assert (e1 : exp x <= 5e-18).
  apply Rle_trans with (exp (-40)); [apply Rlt_le, exp_increasing; lra | interval with (i_prec 60)].
apply near in E; rewrite U in E; lra.
Qed.

(* `weight_at` of the squared distance that leaves the slack s; 0 stands for no link. *)
Definition weight_at_fl s := if Rlt_dec s 0 then 0 else
  if Rlt_dec (exponent_fl q2 s) (-40) then fl (q1 / 2) else weight_fl q1 (exp_fl (exponent_fl q2 s)).

Lemma weight_at_error s : s <= 1e270 -> Rabs (weight_at_fl s - rise q1 q2 (Rmax s 0)) <= 3.2e-15.
Proof.
intro s_small; unfold weight_at_fl; destruct (Rlt_dec s 0) as [neg | nonneg].
  rewrite Rmax_right by lra; unfold rise; rewrite !Rmult_0_r, Ropp_0, exp_0.
  replace (0 - (q1 / (1 + 1) - q1 / 2)) with 0 by field; rewrite Rabs_R0; lra.
rewrite Rmax_left by lra; assert (s0 : 0 <= s) by lra; assert (q2_pos : 0 < q2) by lra.
assert (X := exponent_error q2 s q2_pos s0 s_small); apply near in X; assert (U := u_value); rewrite U in X.
destruct (Rlt_dec _ _) as [far | close].
  set (z := q2 * (s * s)) in *; assert (z40 : 39.9 <= z) by (assert (0 <= z) by (apply Rmult_le_pos; [lra | apply Rmult_le_pos; lra]); lra).
  unfold rise; fold z; set (E := exp (- z)).
  assert (E0 : 0 < E) by apply exp_pos.
  assert (E1 : E <= 5e-18).
    apply Rle_trans with (exp (-39.9)); [| interval with (i_prec 60)].
    unfold E; destruct (Req_dec z 39.9) as [-> | ne]; [lra | apply Rlt_le, exp_increasing; lra].
  assert (H2 : Rabs (q1 / 2) <= 2) by (apply Rabs_le; lra).
  assert (F := fl_abs _ _ H2); rewrite U in F; apply near in F.
  assert (part : q1 / (1 + E) = q1 - q1 * (E / (1 + E))) by (field; lra).
  assert (quotient : 0 <= E / (1 + E) <= E).
    split; [apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra] |].
    apply Rmult_le_reg_r with (1 + E); [lra | unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra; nra].
  rewrite part; assert (0 <= q1 * (E / (1 + E)) <= 4 * 5e-18) by (split; [apply Rmult_le_pos | apply Rmult_le_compat]; lra).
  apply Rabs_le; lra.
apply weight_error; try assumption; set (z := q2 * (s * s)) in *; lra.
Qed.

Variables (k : nat) (x y : nat -> R) (radius : R).
Hypothesis k3 : (k <= 3)%nat.
Hypothesis doubles : forall d, double (x d) /\ double (y d).
Hypothesis radius_range : 0 <= radius <= 1e6.
Let R2 := radius * radius.
Let D := distance2 k x y.
Let s := slack_fl k x y radius.

Lemma moved_weight s0 s1 : 0 <= s0 -> 0 <= s1 -> Rabs (rise q1 q2 s1 - rise q1 q2 s0) <= 0.3936 * q1 * sqrt q2 * Rabs (s1 - s0).
Proof.
intros h0 h1; assert (q2_pos : 0 < q2) by lra.
assert (bound : forall a b, 0 <= a -> a <= b -> 0 <= rise q1 q2 b - rise q1 q2 a <= 0.3936 * q1 * sqrt q2 * (b - a)).
  intros a b a0 ab; apply rise_between; [lra | lra | lra |].
  intros c cin; apply slope_bound; lra.
destruct (Rle_lt_dec s0 s1) as [le | lt].
  assert (B := bound s0 s1 h0 le); rewrite !Rabs_pos_eq by lra; lra.
assert (B := bound s1 s0 h1 (Rlt_le _ _ lt)); rewrite !Rabs_left1 by lra; lra.
Qed.

Theorem link_error : Rabs (weight_at_fl s - weight q1 q2 R2 D) <= 3.3e-15 + 3.7e-16 * (q1 * sqrt q2 * R2).
Proof.
assert (P := distance2_nonneg k x y); fold D in P; assert (r := R2_range radius radius_range); fold R2 in r.
assert (L := least_small); assert (l0 : 0 < least) by (unfold least; apply Rinv_0_lt_compat, IZR_lt; reflexivity).
assert (r0 := sqrt_pos q2); assert (root : sqrt q2 <= 1e8).
  rewrite <- (sqrt_square 1e8) by lra; apply sqrt_le_1; lra.
set (Q := q1 * sqrt q2); assert (Q0 : 0 <= Q <= 4e8) by (unfold Q; split; [apply Rmult_le_pos; lra | apply Rle_trans with (4 * 1e8); [apply Rmult_le_compat; lra | lra]]).
assert (QR : 0 <= Q * R2) by (apply Rmult_le_pos; lra).
destruct (Rle_lt_dec D (R2 * (1 + 1e-14) + 3 * least)) as [few | many].
  assert (S := slack_error k x y radius k3 doubles radius_range few); fold R2 D s in S.
  assert (big : s <= 1e270) by (apply near in S; lra).
  assert (W := weight_at_error s big).
  assert (M := moved_weight (Rmax (R2 - D) 0) (Rmax s 0) (Rmax_r _ _) (Rmax_r _ _)).
  assert (clip : Rabs (Rmax s 0 - Rmax (R2 - D) 0) <= 9.2e-16 * R2 + 3 * least).
    apply near in S; apply Rabs_le; unfold Rmax; destruct (Rle_dec s 0); destruct (Rle_dec (R2 - D) 0); lra.
  replace (0.3936 * q1 * sqrt q2) with (0.3936 * Q) in M by (unfold Q; ring).
  assert (M' : 0.3936 * Q * Rabs (Rmax s 0 - Rmax (R2 - D) 0) <= 0.3936 * Q * (9.2e-16 * R2 + 3 * least)) by (apply Rmult_le_compat_l; lra).
  assert (tiny : Q * least <= 4e8 * 1e-40) by (apply Rmult_le_compat; lra).
  unfold weight; fold Q; replace (weight_at_fl s - rise q1 q2 (Rmax (R2 - D) 0)) with
    ((weight_at_fl s - rise q1 q2 (Rmax s 0)) + (rise q1 q2 (Rmax s 0) - rise q1 q2 (Rmax (R2 - D) 0))) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _); lra.
assert (neg : s < 0).
  destruct (Rle_lt_dec 0 s) as [pos | neg]; [exfalso | exact neg].
  assert (O := out_of_range k x y radius k3 doubles radius_range (Rle_ge _ _ pos)); fold D R2 in O; lra.
assert (q2_pos : 0 < q2) by lra; assert (0 <= R2 * 1e-14) by lra.
rewrite weight_out_of_range by lra.
unfold weight_at_fl; destruct (Rlt_dec s 0) as [_ | no]; [rewrite Rminus_0_r, Rabs_R0; fold Q; lra | lra].
Qed.

Theorem link_error_paper : q1 * sqrt q2 * R2 <= 18 -> Rabs (weight_at_fl s - weight q1 q2 R2 D) <= 1e-14.
Proof. intro gentle; assert (H := link_error); lra. Qed.

Theorem link_error_chosen : sqrt q2 * R2 <= 151 -> Rabs (weight_at_fl s - weight q1 q2 R2 D) <= 2.3e-13.
Proof.
intro chosen; assert (H := link_error); assert (r := R2_range radius radius_range); fold R2 in r; assert (r0 := sqrt_pos q2).
assert (q1 * (sqrt q2 * R2) <= 4 * 151) by (apply Rmult_le_compat; try lra; apply Rmult_le_pos; lra).
replace (q1 * (sqrt q2 * R2)) with (q1 * sqrt q2 * R2) in * by ring; lra.
Qed.
End Weight.
