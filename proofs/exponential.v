(* The error of the one exponential (crates/core/src/num/exponential.rs).

   In words. For |x| <= 700 the exponential as the code computes it, in doubles with every operation rounded to nearest, is wrong by at most
   2.5 * 2^-53 of e^x (`exp_error`): x = (64 k + m) ln 2/64 + r, a table of the 64 numbers 2^(m/64), and a polynomial in r.

   `table_right`: each number of the table is 2^(m/64) to 2^-53, so correctly rounded. `tail_error`: the polynomial is e^r - 1 to 4e-17.

   What is computed with bits there is arithmetic here: 2^k is multiplied, which is exact for |x| <= 700. *)

From Coq Require Import ZArith Reals Lra Psatz Lia List.
From Flocq.Core Require Import Core.
From Interval Require Import Tactic.
From Closeranks Require Import intervals rounding.
Import ExactIntervals ListNotations.
Local Open Scope R_scope.

Definition per_unit := 3248660424278399 / 2 ^ 45.
Definition high := 93032639 / 2 ^ 33.
Definition low := 1676153373520505 / 2 ^ 84.
Definition sixth := 6004799503160661 / 2 ^ 55.
Definition c24 := 6004799503160661 / 2 ^ 57.
Definition c120 := 4803839602528529 / 2 ^ 59.
Definition shift := 6755399441055744%Z.
(* Times 2^-52. *)
Definition table : list Z := [
   4503599627370496; 4552640611975265; 4602215617889652; 4652330460224456; 4702991017412879; 4754203231900066;
   4805973110840145; 4858306726800864; 4911210218475899; 4964689791404917; 5018751718701482; 5073402341788886;
   5128648071143992; 5184495387049181; 5240950840352481; 5298021053235979; 5355712719992597; 5414032607811327;
   5472987557571019; 5532584484642807; 5592830379701282; 5653732309544490; 5715297417922861; 5777532926377168;
   5840446135085607; 5904044423720103; 5968335252311938; 6033326162126810; 6099024776549417; 6165438801977672;
   6232576028726661; 6300444331942437; 6369051672525773; 6438406098065967; 6508515743784820; 6579388833490889;
   6651033680544135; 6723458688831074; 6796672353750547; 6870683263210221; 6945500098633947; 7021131635980086;
   7097586746770917; 7174874399133264; 7253003658850448; 7331983690425701; 7411823758157149; 7492533227224511;
   7574121564787629; 7656598341096955; 7739973230616135; 7824256013156818; 7909456575025820; 7995584910184779;
   8082651121422441; 8170665421539708; 8259638134547591; 8349579696878213; 8440500658608991; 8532411684700150;
   8625323556245722; 8719247171738151; 8814193548346688; 8910173823209688]%Z.
Definition table_at (m : nat) := IZR (nth m table 0%Z) / 2 ^ 52.

Section Exponential.
Variable x : R.
Definition steps := fl (fl (fl (x * per_unit) + IZR shift) - IZR shift).
Definition rest := fl (fl (x - fl (steps * high)) - fl (steps * low)).
Definition square := fl (rest * rest).
Definition tail := fl (fl (rest + fl (square * fl (1 / 2 + fl (rest * sixth))))
  + fl (fl (square * square) * fl (c24 + fl (rest * c120)))).
Definition whole := Zfloor steps.
Definition root := table_at (Z.to_nat (whole mod 64)) * bpow radix2 (whole / 64).
Definition exp_fl := fl (root + fl (root * tail)).
End Exponential.

Lemma fl_abs t B : Rabs t <= B -> Rabs (fl t - t) <= u * B + 1e-30.
Proof.
intro H; assert (E := fl_error t); assert (U := u_pos); assert (S := eta_small).
assert (least <= 1e-24).
  unfold least; assert (/ IZR (10 ^ 300) <= / IZR (10 ^ 24)) by (apply Rinv_le_contravar; [apply IZR_lt; reflexivity | apply IZR_le; vm_compute; discriminate]).
  simpl (10 ^ 24)%Z in *; lra.
assert (u * Rabs t <= u * B) by (apply Rmult_le_compat_l; lra); lra.
Qed.

Lemma near a b e : Rabs (a - b) <= e -> b - e <= a <= b + e.
Proof. intro H; apply Rabs_le_inv in H; lra. Qed.

(* Numbers of few bits are not rounded. *)
Lemma fl_exact n e : (Z.abs n < 2 ^ 53)%Z -> (-1074 <= e)%Z -> fl (IZR n * bpow radix2 e) = IZR n * bpow radix2 e.
Proof.
intros small least; apply round_generic; [apply valid_rnd_N |].
apply generic_format_FLT; exists (Float radix2 n e); [reflexivity | exact small | exact least].
Qed.
Lemma fl_whole n : (Z.abs n < 2 ^ 53)%Z -> fl (IZR n) = IZR n.
Proof. intro small; assert (H := fl_exact n 0 small ltac:(lia)); simpl in H; rewrite Rmult_1_r in H; exact H. Qed.

(* From 2^52 to 2^53 rounding goes to the closest whole number. *)
Lemma fl_large t : IZR (2 ^ 52) <= t < IZR (2 ^ 53) -> fl t = IZR (ZnearestE t).
Proof.
intros [l h]; assert (M : mag radix2 t = 53%Z :> Z).
  apply mag_unique_pos; change (53 - 1)%Z with 52%Z; rewrite <- !(IZR_Zpower radix2) by lia; split; assumption.
unfold fl, round, scaled_mantissa, cexp, FLT_exp, F2R; rewrite M; simpl; rewrite !Rmult_1_r; reflexivity.
Qed.

Section Error.
Variable x : R.
Hypothesis x700 : -700 <= x <= 700.
Let y := fl (x * per_unit).

Lemma y_near : x * per_unit - 1e-11 <= y <= x * per_unit + 1e-11.
Proof.
apply near; apply Rle_trans with (u * 64700 + 1e-30); [| rewrite u_value; lra].
apply fl_abs; apply Rabs_le; unfold per_unit; lra.
Qed.

Lemma steps_whole : exists n : Z, steps x = IZR n /\ (Z.abs n <= 64700)%Z /\ Rabs (IZR n - x * per_unit) <= 0.5 + 1e-11.
Proof.
assert (Y := y_near); assert (P : -64650 <= x * per_unit <= 64650) by (unfold per_unit; lra).
assert (range : IZR (2 ^ 52) <= y + IZR shift < IZR (2 ^ 53)) by (unfold shift; simpl (2 ^ 52)%Z; simpl (2 ^ 53)%Z; lra).
assert (R := fl_large _ range); set (m := ZnearestE (y + IZR shift)) in *.
assert (half : Rabs (y + IZR shift - IZR m) <= / 2) by apply Znearest_half.
assert (close : Rabs (IZR (m - shift) - x * per_unit) <= 0.5 + 1e-11).
  rewrite minus_IZR; apply Rabs_le_inv in half; apply Rabs_le; lra.
assert (small : (Z.abs (m - shift) <= 64700)%Z).
  apply le_IZR; rewrite abs_IZR; apply Rabs_le_inv in close; apply Rabs_le; lra.
exists (m - shift)%Z; split; [| split; assumption].
unfold steps; fold y; rewrite R, <- minus_IZR; apply fl_whole; lia.
Qed.

Variable n : Z.
Hypothesis is_n : steps x = IZR n.
Hypothesis n_small : (Z.abs n <= 64700)%Z.
Hypothesis n_near : Rabs (IZR n - x * per_unit) <= 0.5 + 1e-11.
(* What is left of x, without rounding. *)
Let residue := x - IZR n * (ln 2 / 64).

Lemma n_range : -64700 <= IZR n <= 64700.
Proof. apply Rabs_le_inv; rewrite <- abs_IZR; apply IZR_le; exact n_small. Qed.

Lemma residue_small : -0.0054153 <= residue <= 0.0054153.
Proof.
apply near in n_near; unfold residue.
assert (L : Rabs (ln 2 / 64 * per_unit - 1) <= 1e-16) by (unfold per_unit; interval with (i_prec 100)).
assert (l0 : 0.01083 <= ln 2 / 64 <= 0.0108305) by (split; interval with (i_prec 60)).
set (l := ln 2 / 64) in *; apply near in L.
assert (a : l * (x * per_unit - (0.5 + 1e-11)) <= l * IZR n <= l * (x * per_unit + (0.5 + 1e-11))) by (split; apply Rmult_le_compat_l; lra).
assert (b : Rabs (x * (l * per_unit - 1)) <= 700 * 1e-16) by (rewrite Rabs_mult; apply Rmult_le_compat; try apply Rabs_pos; apply Rabs_le; lra).
apply Rabs_le_inv in b; lra.
Qed.

Lemma rest_error : Rabs (rest x - residue) <= 1.3e-18.
Proof.
assert (N := n_range); assert (T := residue_small); unfold rest; rewrite is_n.
assert (E1 : fl (IZR n * high) = IZR n * high).
  assert (H : IZR n * high = IZR (n * 93032639) * bpow radix2 (-33)) by (rewrite mult_IZR; unfold high; simpl bpow; lra).
  rewrite H; apply fl_exact; lia.
rewrite E1; assert (L : Rabs (high + low - ln 2 / 64) <= 1e-26) by (unfold high, low; interval with (i_prec 140)).
apply near in L; assert (lo : 0 <= low <= 8.67e-11) by (unfold low; lra).
assert (nl : Rabs (IZR n * low) <= 5.7e-6).
  rewrite Rabs_mult; apply Rle_trans with (64700 * 8.67e-11); [| lra].
  apply Rmult_le_compat; try apply Rabs_pos; apply Rabs_le; lra.
assert (d2 := fl_abs _ _ nl); assert (nl' := Rabs_le_inv _ _ nl).
assert (gap : Rabs (IZR n * (high + low - ln 2 / 64)) <= 64700 * 1e-26).
  rewrite Rabs_mult; apply Rmult_le_compat; try apply Rabs_pos; apply Rabs_le; lra.
apply Rabs_le_inv in gap.
assert (first : Rabs (x - IZR n * high) <= 0.00543) by (apply Rabs_le; unfold residue in T; lra).
assert (d1 := fl_abs _ _ first); rewrite u_value in d1, d2; apply near in d1; apply near in d2.
assert (second : Rabs (fl (x - IZR n * high) - fl (IZR n * low)) <= 0.00543) by (apply Rabs_le; unfold residue in T; lra).
assert (d3 := fl_abs _ _ second); rewrite u_value in d3; apply near in d3.
apply Rabs_le; unfold residue; lra.
Qed.

Lemma rest_small : -0.0054154 <= rest x <= 0.0054154.
Proof. assert (R := rest_error); assert (T := residue_small); apply near in R; lra. Qed.

(* The polynomial, without rounding. *)
Definition taylor r := r + r * r * (1 / 2 + r / 6) + r * r * (r * r) * (1 / 24 + r / 120).

Lemma taylor_error r : -0.0054154 <= r <= 0.0054154 -> Rabs (taylor r - (exp r - 1)) <= 3.6e-17.
Proof. intro H; unfold taylor; interval with (i_bisect r, i_taylor r, i_degree 8, i_prec 120, i_depth 12). Qed.

Lemma product a b A B : Rabs a <= A -> Rabs b <= B -> Rabs (a * b) <= A * B.
Proof. intros; rewrite Rabs_mult; apply Rmult_le_compat; try apply Rabs_pos; assumption. Qed.

(* A rounded product of factors that are wrong themselves. *)
Lemma times a a' b b' A B da db : Rabs a <= A -> Rabs b' <= B -> Rabs (a' - a) <= da -> Rabs (b' - b) <= db ->
  Rabs (fl (a' * b') - a * b) <= u * ((A + da) * B) + 1e-30 + (da * B + A * db).
Proof.
intros HA HB Ha Hb.
assert (A' : Rabs a' <= A + da) by (replace a' with (a + (a' - a)) by ring; apply Rle_trans with (1 := Rabs_triang _ _); lra).
assert (F := fl_abs _ _ (product _ _ _ _ A' HB)).
assert (G : Rabs (a' * b' - a * b) <= da * B + A * db).
  replace (a' * b' - a * b) with ((a' - a) * b' + a * (b' - b)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _); apply Rplus_le_compat; apply product; assumption.
replace (fl (a' * b') - a * b) with ((fl (a' * b') - a' * b') + (a' * b' - a * b)) by ring.
apply Rle_trans with (1 := Rabs_triang _ _); lra.
Qed.

Lemma tail_rounding : Rabs (tail x - taylor (rest x)) <= 1.3e-18.
Proof.
assert (S := rest_small); unfold tail, taylor, square; set (r := rest x) in *.
assert (r0 : Rabs r <= 0.0054154) by (apply Rabs_le; lra).
assert (same : Rabs (r - r) <= 0) by (rewrite Rminus_diag_eq, Rabs_R0; lra).
assert (rr : Rabs (fl (r * r) - r * r) <= 4e-21).
  apply Rle_trans with (1 := times _ _ _ _ _ _ _ _ r0 r0 same same); rewrite u_value; lra.
set (q := fl (r * r)) in *; assert (q0 : Rabs (r * r) <= 2.94e-5) by (apply Rle_trans with (1 := product _ _ _ _ r0 r0); lra).
assert (q1 : Rabs q <= 2.95e-5) by (apply near in rr; apply Rabs_le_inv in q0; apply Rabs_le; lra).
assert (s1 : Rabs (sixth - / 6) <= 1e-17) by (apply Rabs_le; unfold sixth; lra).
assert (s2 : Rabs sixth <= 0.17) by (apply Rabs_le; unfold sixth; lra).
assert (p1 := times _ _ _ _ _ _ _ _ r0 s2 same s1); set (t1 := fl (r * sixth)) in *.
assert (t0 : Rabs (r * / 6) <= 0.00091) by (apply Rabs_le; lra).
assert (b1 : Rabs t1 <= 0.001) by (rewrite u_value in p1; apply near in p1; apply Rabs_le_inv in t0; apply Rabs_le; lra).
assert (a1 : Rabs (1 / 2 + t1) <= 0.502) by (apply Rabs_le_inv in b1; apply Rabs_le; lra).
assert (f1 := fl_abs _ _ a1); set (a := fl (1 / 2 + t1)) in *.
assert (ea : Rabs (a - (1 / 2 + r / 6)) <= 6e-17).
  rewrite u_value in f1, p1; apply near in f1; apply near in p1; apply Rabs_le; lra.
assert (a0 : Rabs a <= 0.502) by (apply near in ea; apply Rabs_le; lra).
assert (p2 := times _ _ _ _ _ _ _ _ q0 a0 rr ea); set (t2 := fl (q * a)) in *.
assert (e2 : Rabs (t2 - r * r * (1 / 2 + r / 6)) <= 6e-21) by (apply Rle_trans with (1 := p2); rewrite u_value; lra).
assert (g2 : Rabs (r * r * (1 / 2 + r / 6)) <= 1.49e-5).
  apply Rle_trans with (2.94e-5 * 0.502); [apply product; [exact q0 | apply Rabs_le; lra] | lra].
assert (u2 : Rabs (r + t2) <= 0.0054304) by (apply near in e2; apply Rabs_le_inv in g2; apply Rabs_le; lra).
assert (f2 := fl_abs _ _ u2); set (c := fl (r + t2)) in *.
assert (s3 : Rabs (c120 - / 120) <= 1e-18) by (apply Rabs_le; unfold c120; lra).
assert (s4 : Rabs c120 <= 0.0084) by (apply Rabs_le; unfold c120; lra).
assert (p3 := times _ _ _ _ _ _ _ _ r0 s4 same s3); set (t3 := fl (r * c120)) in *.
assert (t4 : Rabs (r * / 120) <= 4.6e-5) by (apply Rabs_le; lra).
assert (b3 : Rabs t3 <= 5e-5) by (rewrite u_value in p3; apply near in p3; apply Rabs_le_inv in t4; apply Rabs_le; lra).
assert (a3 : Rabs (c24 + t3) <= 0.042) by (apply Rabs_le_inv in b3; apply Rabs_le; unfold c24; lra).
assert (f3 := fl_abs _ _ a3); set (b := fl (c24 + t3)) in *.
assert (eb : Rabs (b - (1 / 24 + r / 120)) <= 1e-17).
  rewrite u_value in f3, p3; apply near in f3; apply near in p3; apply Rabs_le; unfold c24 in *; lra.
assert (b0 : Rabs b <= 0.042) by (apply near in eb; apply Rabs_le; lra).
assert (p4 := times _ _ _ _ _ _ _ _ q0 q1 rr rr); set (t5 := fl (q * q)) in *.
assert (e4 : Rabs (t5 - r * r * (r * r)) <= 1e-24) by (apply Rle_trans with (1 := p4); rewrite u_value; lra).
assert (g4 : Rabs (r * r * (r * r)) <= 8.7e-10) by (apply Rle_trans with (1 := product _ _ _ _ q0 q0); lra).
assert (p5 := times _ _ _ _ _ _ _ _ g4 b0 e4 eb); set (t6 := fl (t5 * b)) in *.
assert (e5 : Rabs (t6 - r * r * (r * r) * (1 / 24 + r / 120)) <= 1e-25) by (apply Rle_trans with (1 := p5); rewrite u_value; lra).
assert (g5 : Rabs (r * r * (r * r) * (1 / 24 + r / 120)) <= 3.7e-11).
  apply Rle_trans with (8.7e-10 * 0.0419); [apply product; [exact g4 | apply Rabs_le; lra] | lra].
rewrite u_value in f2; apply near in f2; apply near in e5; apply near in e2; apply Rabs_le_inv in g5; apply Rabs_le_inv in u2.
assert (u6 : Rabs (c + t6) <= 0.0054305) by (apply Rabs_le; lra).
assert (f6 := fl_abs _ _ u6); rewrite u_value in f6; apply near in f6; apply Rabs_le; lra.
Qed.

Theorem tail_error : Rabs (tail x - (exp residue - 1)) <= 4e-17.
Proof.
assert (A := tail_rounding); assert (B := taylor_error _ rest_small); assert (C := rest_error).
assert (D : Rabs (exp (rest x) - exp residue) <= 1.4e-18).
  assert (T := residue_small); set (d := rest x - residue) in *.
  replace (rest x) with (residue + d) by (unfold d; ring); rewrite exp_plus.
  replace (exp residue * exp d - exp residue) with (exp residue * (exp d - 1)) by ring.
  apply Rle_trans with (1.006 * 1.31e-18); [| lra]; apply product.
    interval with (i_prec 60).
  apply Rabs_le_inv in C; interval with (i_prec 120, i_taylor d, i_degree 3).
apply near in A; apply near in B; apply near in D; apply Rabs_le; lra.
Qed.
End Error.

Lemma table_right m : (m < 64)%nat -> Rabs (table_at m - exp (INR m * (ln 2 / 64))) <= / 2 ^ 53.
Proof.
intro small; do 64 (destruct m as [| m]; [unfold table_at; simpl nth; simpl INR; interval with (i_prec 120) |]); lia.
Qed.

(* A rounded number, as a multiple of a power of two that is not too small. *)
Lemma fl_scaled s p B : 0 < p -> eta <= 1e-19 * p -> Rabs s <= B -> exists a, fl (s * p) = (s + a) * p /\ Rabs a <= u * B + 1e-19.
Proof.
intros p0 tiny HB; assert (F := fl_error (s * p)); assert (U := u_pos).
exists ((fl (s * p) - s * p) / p); split; [field; lra |].
unfold Rdiv; rewrite Rabs_mult, (Rabs_pos_eq (/ p)) by (apply Rlt_le, Rinv_0_lt_compat; exact p0).
apply Rmult_le_reg_r with p; [exact p0 |]; rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
rewrite Rabs_mult, (Rabs_pos_eq p) in F by lra.
assert (u * (Rabs s * p) <= u * (B * p)) by (apply Rmult_le_compat_l; [lra | apply Rmult_le_compat_r; lra]); lra.
Qed.

Theorem exp_error x : -700 <= x <= 700 -> Rabs (exp_fl x - exp x) <= 2.5 * u * exp x.
Proof.
intro x700; destruct (steps_whole x x700) as [n [is_n [small close]]].
assert (T0 := tail_error x x700 n is_n small close); assert (R0 := residue_small x x700 n close).
set (residue := x - IZR n * (ln 2 / 64)) in *; set (t := tail x) in *.
unfold exp_fl, root, whole; rewrite is_n, Zfloor_IZR; fold t.
assert (parts := Z.div_mod n 64 ltac:(lia)); assert (mod64 := Z.mod_pos_bound n 64 ltac:(lia)).
set (k := (n / 64)%Z) in *; set (m := (n mod 64)%Z) in *.
assert (right := table_right (Z.to_nat m) ltac:(lia)).
rewrite INR_IZR_INZ, Z2Nat.id in right by lia; set (T := table_at (Z.to_nat m)) in *.
set (base := exp (IZR m * (ln 2 / 64))) in *; set (E := exp residue) in *; set (p := bpow radix2 k).
assert (m0 : 0 <= IZR m <= 63) by (split; [apply (IZR_le 0) | apply (IZR_le m 63)]; lia).
assert (l0 : 0 < ln 2 / 64 <= 0.0109) by (split; interval with (i_prec 60)).
assert (b0 : 1 <= base <= 2).
  assert (0 <= IZR m * (ln 2 / 64) <= 63 * 0.0109) by (split; [apply Rmult_le_pos | apply Rmult_le_compat]; lra).
  unfold base; set (z := IZR m * (ln 2 / 64)) in *; split; [rewrite <- exp_0; destruct (Req_dec z 0) as [-> | ne]; [lra | apply Rlt_le, exp_increasing; lra] | interval with (i_prec 60)].
assert (E0 : 0.9945 <= E <= 1.0055) by (unfold E; split; interval with (i_prec 60)).
assert (p0 : 0 < p) by apply bpow_gt_0.
assert (tiny : eta <= 1e-19 * p).
  assert (le : bpow radix2 (-1074) <= bpow radix2 (-63) * p).
    unfold p; rewrite <- bpow_plus; apply bpow_le; lia.
  assert (bpow radix2 (-63) <= 1.1e-19) by (simpl bpow; lra).
  assert (bpow radix2 (-63) * p <= 1.1e-19 * p) by (apply Rmult_le_compat_r; lra); unfold eta; lra.
assert (value : exp x = base * E * p).
  unfold base, E, p; rewrite bpow_exp; change (IZR radix2) with 2; rewrite <- !exp_plus; f_equal.
  unfold residue; rewrite parts at 1; rewrite plus_IZR, mult_IZR; field.
replace (/ 2 ^ 53) with u in right by (rewrite u_value; lra).
assert (U := u_value); apply near in right; apply near in T0.
assert (Tt : Rabs (T * t) <= 0.0112) by (apply Rle_trans with (2.0001 * 0.00551); [apply product; apply Rabs_le; lra | lra]).
replace (T * p * t) with (T * t * p) by ring; destruct (fl_scaled _ p _ p0 tiny Tt) as [a [-> a0]].
replace (T * p + (T * t + a) * p) with ((T + (T * t + a)) * p) by ring.
assert (c0 : Rabs ((T - base) * (1 + t)) <= u * 1.0056) by (apply product; apply Rabs_le; lra).
assert (d0 : Rabs (base * (t - (E - 1))) <= base * 4e-17).
  apply product; [rewrite Rabs_pos_eq; lra | apply Rabs_le; lra].
assert (sum : T + (T * t + a) = base * E + (T - base) * (1 + t) + base * (t - (E - 1)) + a) by ring.
set (c := (T - base) * (1 + t)) in *; set (d := base * (t - (E - 1))) in *; set (X := base * E) in *.
assert (X0 : base * 0.9945 <= X) by (unfold X; apply Rmult_le_compat_l; lra).
rewrite U in a0, c0; apply Rabs_le_inv in a0; apply Rabs_le_inv in c0; apply Rabs_le_inv in d0.
assert (s0 : Rabs (T + (T * t + a)) <= X * (1 + 1e-15)) by (rewrite sum; apply Rabs_le; lra).
destruct (fl_scaled _ p _ p0 tiny s0) as [b [-> b0']]; rewrite U in b0'; apply Rabs_le_inv in b0'.
rewrite value, sum; fold X.
replace ((X + c + d + a + b) * p - X * p) with ((c + d + a + b) * p) by ring.
rewrite Rabs_mult, (Rabs_pos_eq p), <- Rmult_assoc by lra; apply Rmult_le_compat_r; [lra |].
rewrite U; apply Rabs_le; lra.
Qed.
