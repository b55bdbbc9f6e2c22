(* The bound of a gradient's error as it is computed (crates/core/src/controller/budget/curvature.rs: `gradient_error`; docs/theory/weights.md: eq:gradient-error).

   In words. The code takes the larger of K at the point of an interval of s closest to the stored peak and of `swell` at its low end, raises it by a factor 1 + 1e-12, and
   multiplies it by the error E. Every operation is rounded. 0 < q1 <= 4, 0 < q2 <= 1e15, 0 <= R <= 1e6, sqrt(q2) R^2 <= 150.5, and E is a double of at most R.

   `larger_enough`: K(s) E and swell(s) E are at most the computed bound, and 1e-240, for every s between the two ends as they are stored. So the factor covers all rounding
   for given ends.
   `gradient_error_computed`: the gradient at an offset of length d that is wrong by at most E differs from the one at the true offset by at most the computed bound
   and q1 q2 R^2 (1.2e-15 (3.2 + 6 sqrt(q2) R^2) E + 2.5e-15 R) and 1e-200. The middle term is what the ends are wrong by. Its second part is for a pair that is within R by less than
   can be seen. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Closeranks Require Import intervals vectors weights curvature peak bend_peak rounding exponential weight_rounded link_rounded slope_rounded slope_max_rounded
  bend_rounded bend_max_rounded bend_gap bend_test_rounded bend_peak_rounded gradient_error swell_rounded.
Local Open Scope R_scope.
Local Existing Instance prec_53.

Section Bound.
Variables q1 q2 : R.
Hypothesis q1_range : 0 < q1 <= 4.
Hypothesis q2_range : 0 < q2 <= 1e15.
Variable far : R -> R.
Hypothesis far_range : forall x, 0 <= far x <= 0.05.
Let fn : forall x, 0 <= far x := far_nonneg far far_range.
Let q1_nonneg : 0 <= q1 := Rlt_le _ _ (proj1 q1_range).
Let q2_pos : 0 < q2 := proj1 q2_range.

Section Ends.
Variable R2 : R.
Hypothesis R2_range : 0 <= R2 <= 1e13.
Hypothesis R2_double : double R2.
Hypothesis steep : sqrt q2 * R2 <= 151.
Let K := curvature.K q1 q2 R2.
Let swell := gradient_error.swell q1 q2 R2.

Definition larger_fl lo hi := Rmax (bend_fl q1 q2 R2 far (closest (sharpest_fl q2 R2 far) lo hi)) (swell_fl q1 q2 R2 far lo).
Definition bound_fl lo hi e := fl (fl (raise * larger_fl lo hi) * e).

Lemma K_room lo hi s : 0 <= lo -> lo <= s <= hi -> hi <= R2 -> (1 + 9e-14) * K s <= fl (raise * larger_fl lo hi) + 1e-250.
Proof.
intros lo0 sin hiR; destruct (steepest q2_pos) as [star [star0 [turns _]]].
destruct (single_peak q1_nonneg q2_pos star0 turns (proj1 R2_range)) as [hat [hin is_peak]].
assert (H := bend_max_room q1 q2 R2 q1_range q2_range R2_range steep far fn (sharpest_fl q2 R2 far) hat is_peak (stored_range q2 R2 far R2_range R2_double)
  (stored_peak q1 q2 R2 far q1_range q2_range R2_range R2_double steep far_range hat hin) lo hi s lo0 sin hiR).
apply Rle_trans with (1 := H), Rplus_le_compat_r; unfold bend_max_fl; apply fl_mono, Rmult_le_compat_l; [assert (r := raise_range); lra | apply Rmax_l].
Qed.

Lemma larger_nonneg lo hi : 0 <= lo <= hi -> hi <= R2 -> 0 <= larger_fl lo hi.
Proof.
intros lo0 hiR; assert (c := closest_in (sharpest_fl q2 R2 far) lo hi (proj2 lo0)).
apply Rle_trans with (2 := Rmax_l _ _), bend_nonneg; [exact q1_range | exact q2_range | exact fn | lra].
Qed.

Lemma swell_room lo hi s : 0 <= lo -> lo <= s <= hi -> hi <= R2 -> (1 + 9e-14) * swell s <= fl (raise * larger_fl lo hi) + 1e-250.
Proof.
intros lo0 sin hiR; assert (P := larger_nonneg lo hi ltac:(lra) hiR); assert (rr := raise_range).
assert (L0 : 0 <= raise * larger_fl lo hi) by (apply Rmult_le_pos; lra); assert (L := fl_nonneg _ L0).
assert (F := swell_falls q1_nonneg q2_pos lo0 (proj1 sin) (Rle_trans _ _ _ (proj2 sin) hiR)); fold (swell s) (swell lo) in F.
destruct (Rle_lt_dec (swell lo) 0) as [none | some]; [rewrite Rmax_left in F by exact none; lra |].
rewrite Rmax_right in F by lra; apply Rle_trans with ((1 + 9e-14) * swell lo); [apply Rmult_le_compat_l; lra |].
destruct (swell_low q1 q2 R2 q1_range q2_range R2_range steep far fn lo ltac:(lra)) as [less | low]; fold (swell lo) in *.
  assert (H := K_room lo hi lo lo0 ltac:(lra) hiR); apply Rle_trans with (2 := H), Rmult_le_compat_l; [lra | exact less].
assert (top : Rmax 0 (swell_fl q1 q2 R2 far lo) <= larger_fl lo hi) by (apply Rmax_lub; [exact P | apply Rmax_r]).
assert (up := fl_low _ L0); assert (U := u_value); assert (n := eta_small); assert (l := least_is 1 ltac:(lra)).
assert (raised : (1 + 9.99e-13) * larger_fl lo hi <= raise * larger_fl lo hi) by (apply Rmult_le_compat_r; lra).
rewrite U in up; lra.
Qed.

Theorem larger_enough lo hi s e : 0 <= lo -> lo <= s <= hi -> hi <= R2 -> 0 <= e <= 1e7 ->
  K s * e <= bound_fl lo hi e + 1e-240 /\ swell s * e <= bound_fl lo hi e + 1e-240.
Proof.
intros lo0 sin hiR e0; assert (A := K_room lo hi s lo0 sin hiR); assert (B := swell_room lo hi s lo0 sin hiR).
assert (P := larger_nonneg lo hi ltac:(lra) hiR); assert (rr := raise_range); unfold bound_fl; set (M := fl (raise * larger_fl lo hi)) in *.
assert (M0 : 0 <= M) by (apply fl_nonneg, Rmult_le_pos; lra); assert (Me : 0 <= M * e) by (apply Rmult_le_pos; lra).
assert (F := fl_low _ Me); assert (F0 := fl_nonneg _ Me); assert (U := u_value); assert (n := eta_small); assert (l := least_is 1 ltac:(lra)); assert (n0 := eta_pos).
assert (part : forall t, (1 + 9e-14) * t <= M + 1e-250 -> t * e <= fl (M * e) + 1e-240).
  intros t H; destruct (Rle_lt_dec t 0) as [neg | pos].
    assert (0 <= - t * e) by (apply Rmult_le_pos; lra); lra.
  assert (H' : (1 + 9e-14) * t * e <= (M + 1e-250) * e) by (apply Rmult_le_compat_r; lra); assert (te : 0 <= t * e) by (apply Rmult_le_pos; lra).
  rewrite U in F; lra.
split; apply part; assumption.
Qed.
End Ends.

(* From a distance d and an error E. *)
Variables radius d E : R.
Hypothesis radius_range : 0 <= radius <= 1e6.
Hypothesis steep : sqrt q2 * (radius * radius) <= 150.5.
Hypothesis d_range : 0 <= d <= 1e7.
Hypothesis E_double : double E.
Hypothesis E_range : 0 <= E <= radius.
Let R2 := radius * radius.
Definition least_slack_fl := Rmax 0 (fl (square_fl radius - fl (fl (d + E) * fl (d + E)))).
Definition most_slack_fl := let n := Rmax 0 (fl (d - E)) in fl (square_fl radius - fl (n * n)).
Definition gradient_error_fl := if Rle_dec most_slack_fl 0 then 0 else bound_fl (square_fl radius) least_slack_fl most_slack_fl E.
Let w := 1.2e-15 * R2 + 3e9 * eta.
Let spare := 1.2e-15 * R2 * (q1 * q2) * (3.2 + 6 * (sqrt q2 * R2)).
Let n := Rmax 0 (d - E).

Lemma same_ends : least_slack_fl = low_fl radius d 0 E /\ most_slack_fl = top_fl radius d 0 E.
Proof.
assert (is : fl (fl (2 * 0) + E) = E) by (rewrite Rmult_0_r, fl_zero, Rplus_0_l; apply fl_same; exact E_double).
unfold least_slack_fl, most_slack_fl, low_fl, top_fl, near_fl, farther_fl; rewrite is; split; reflexivity.
Qed.

Lemma swell_moved s a : 0 <= s <= R2 -> 0 <= a <= square_fl radius -> Rabs (s - a) <= w -> swell q1 q2 R2 s <= swell q1 q2 (square_fl radius) a + spare + 1e-245.
Proof.
intros sin ain gap; assert (U := u_value); assert (e := eta_pos); assert (small := eta_small); assert (l := least_small); assert (l0 := least_pos).
assert (r := R2_range radius radius_range); fold R2 in r; assert (G := fl_error R2); rewrite (Rabs_pos_eq R2) in G by lra; change (fl R2) with (square_fl radius) in G; set (Rs := square_fl radius) in *.
assert (qq : 0 <= q1 * q2 <= 4e15) by (split; [apply Rmult_le_pos; lra | apply Rle_trans with (4 * 1e15); [apply Rmult_le_compat; lra | lra]]).
assert (root0 := sqrt_pos q2); assert (root : sqrt q2 <= 1e8) by (rewrite <- (sqrt_square 1e8) by lra; apply sqrt_le_1; lra).
set (Q := q1 * q2 * sqrt q2) in *; assert (Q0 : 0 <= Q <= 4e23).
  unfold Q; split; [apply Rmult_le_pos; lra | apply Rle_trans with (4e15 * 1e8); [apply Rmult_le_compat; lra | lra]].
assert (wp : 0 <= w) by (unfold w; lra).
assert (near_g : forall b c, 0 <= b -> b <= c -> Rabs (g q1 q2 c - g q1 q2 b) <= 1.5 * Q * (c - b)).
  intros b c b0 bc; destruct (mean_of (g q1 q2) (g1 q1 q2) b c (g_derive q1 q2) bc) as [t [tin is]].
  rewrite is, Rabs_mult, (Rabs_pos_eq (c - b)) by lra; apply Rmult_le_compat_r; [lra | apply (bend_slope_bound q1 q2 q1_range q2_range); lra].
assert (D1 : Rabs (f' q1 q2 s - f' q1 q2 a) <= 1.5 * Q * w).
  assert (fs := g_f q1 q2 s); assert (fa := g_f q1 q2 a); apply near in gap.
  destruct (Rle_lt_dec s a) as [le | lt].
    assert (H := near_g s a (proj1 sin) le); assert (1.5 * Q * (a - s) <= 1.5 * Q * w) by (apply Rmult_le_compat_l; lra); apply Rabs_le_inv in H; apply Rabs_le; lra.
  assert (H := near_g a s (proj1 ain) (Rlt_le _ _ lt)); assert (1.5 * Q * (s - a) <= 1.5 * Q * w) by (apply Rmult_le_compat_l; lra); apply Rabs_le_inv in H; apply Rabs_le; lra.
assert (M := slope_rounded.f_moved q1 q2 q1_range q2_range s a (proj1 sin) (proj1 ain)); assert (Ra := f'_range q1 q2 q1_range q2_range a (proj1 ain)).
assert (M' : q1 * q2 / 2 * Rabs (s - a) <= q1 * q2 / 2 * w) by (apply Rmult_le_compat_l; lra).
apply near in D1; apply near in M; apply near in gap; apply Rabs_le_inv in Ra; apply near in G.
assert (c1 : (R2 - s) * f' q1 q2 s <= (R2 - s) * (f' q1 q2 a + 1.5 * Q * w)) by (apply Rmult_le_compat_l; lra).
assert (c2 : (R2 - s) * (1.5 * Q * w) <= R2 * (1.5 * Q * w)) by (apply Rmult_le_compat_r; [assert (0 <= Q * w) by (apply Rmult_le_pos; lra); lra | lra]).
set (v := w + u * R2 + eta); assert (v0 : 0 <= v) by (unfold v; rewrite U; lra).
assert (c3 : (R2 - s - (Rs - a)) * f' q1 q2 a <= v * (q1 * q2 / 2)).
  apply Rle_trans with (Rabs (R2 - s - (Rs - a)) * Rabs (f' q1 q2 a)); [rewrite <- Rabs_mult; apply Rle_abs |].
  apply Rmult_le_compat; try apply Rabs_pos; [apply Rabs_le; unfold v; lra | apply Rabs_le; lra].
assert (tq : q1 * q2 * eta <= 4e15 * eta) by (apply Rmult_le_compat_r; lra).
assert (QR : 0 <= Q * R2 <= 4e35) by (split; [apply Rmult_le_pos; lra | apply Rle_trans with (4e23 * 1e12); [apply Rmult_le_compat; lra | lra]]).
assert (tQ : Q * R2 * eta <= 4e35 * eta) by (apply Rmult_le_compat_r; lra).
assert (T3 : 1e46 * eta <= 1e-250) by (assert (T4 := least_is 1e30 ltac:(lra)); lra).
assert (qR : 0 <= q1 * q2 * R2) by (apply Rmult_le_pos; lra).
assert (id : spare = 3.84e-15 * (q1 * q2 * R2) + 7.2e-15 * (Q * R2 * R2)) by (unfold spare, Q; lra).
rewrite id; unfold swell, v, w in *; rewrite U in *; lra.
Qed.

Section Offset.
Variables (k : nat) (r0 w0 : vec k).
Hypothesis length_is : sq r0 = d * d.
Hypothesis wrong_by : sq w0 <= E * E.

Lemma not_nearer : n * n <= sq (plus r0 w0).
Proof.
unfold n; destruct (Rle_lt_dec (d - E) 0) as [none | some]; [rewrite Rmax_left, Rmult_0_l by exact none; apply sq_nonneg |].
rewrite Rmax_right by lra; rewrite sq_plus, length_is; assert (p0 := sq_nonneg w0); assert (l0 := sqrt_pos (sq w0)); assert (ll := sqrt_sqrt _ p0).
set (l := sqrt (sq w0)) in *; assert (lE : l <= E) by (apply Rsqr_incr_0_var; unfold Rsqr; lra).
assert (cs := cauchy_schwarz r0 w0); rewrite length_is, <- ll in cs; assert (dl : 0 <= d * l) by (apply Rmult_le_pos; lra).
assert (b : - (d * l) <= vectors.dot r0 w0 <= d * l).
  apply Rabs_le_inv; rewrite <- (Rabs_pos_eq _ dl); apply Rsqr_le_abs_0; unfold Rsqr; lra.
rewrite <- ll; assert ((d - E) * (d - E) <= (d - l) * (d - l)) by (apply Rmult_le_compat; lra); lra.
Qed.

(* The gradient of a pair that is within R by so little that the code may see none. *)
Lemma gradient_small (v : vec k) : n * n <= sq v -> R2 - n * n <= w -> sq (gradient q1 q2 R2 v) <= q1 * q2 * w * radius * (q1 * q2 * w * radius).
Proof.
intros far_ few; unfold gradient; rewrite sq_times; assert (wp : 0 <= w) by (unfold w, R2; assert (p := R2_range radius radius_range); assert (e := eta_pos); lra).
assert (qq : 0 <= q1 * q2) by (apply Rmult_le_pos; lra); assert (W : 0 <= q1 * q2 * w) by (apply Rmult_le_pos; lra).
assert (f00 : f q1 q2 0 = 0) by (unfold f; rewrite !Rmult_0_r; unfold Rdiv; rewrite !Rmult_0_l; reflexivity).
destruct (Rle_lt_dec (R2 - sq v) 0) as [out | inn].
  rewrite Rmax_right, f00 by exact out; rewrite !Rmult_0_r, Rmult_0_l; assert (0 <= q1 * q2 * w * radius) by (apply Rmult_le_pos; lra); apply Rmult_le_pos; assumption.
rewrite Rmax_left by lra; set (s := R2 - sq v) in *; assert (M := slope_rounded.f_moved q1 q2 q1_range q2_range s 0 (Rlt_le _ _ inn) (Rle_refl 0)).
rewrite f00, !Rminus_0_r, (Rabs_pos_eq s) in M by lra; apply Rabs_le_inv in M; assert (F := @f_nonneg q1 q2 q1_nonneg q2_pos s (Rlt_le _ _ inn)).
assert (top : q1 * q2 / 2 * s <= q1 * q2 / 2 * w) by (apply Rmult_le_compat_l; unfold s; lra).
assert (sqf : 0 <= -2 * f q1 q2 s * (-2 * f q1 q2 s) <= q1 * q2 * w * (q1 * q2 * w)).
  replace (-2 * f q1 q2 s * (-2 * f q1 q2 s)) with (2 * f q1 q2 s * (2 * f q1 q2 s)) by ring; split; [apply Rmult_le_pos | apply Rmult_le_compat]; lra.
assert (v0 := sq_nonneg v); replace (q1 * q2 * w * radius * (q1 * q2 * w * radius)) with (q1 * q2 * w * (q1 * q2 * w) * R2) by (unfold R2; ring).
apply Rmult_le_compat; unfold s in *; lra.
Qed.

Theorem gradient_error_computed : let bound := gradient_error_fl + q1 * q2 * R2 * (1.2e-15 * (3.2 + 6 * (sqrt q2 * R2)) * E + 2.5e-15 * radius) + 1e-200 in
  sq (minus (gradient q1 q2 R2 (plus r0 w0)) (gradient q1 q2 R2 r0)) <= bound * bound.
Proof.
cbv zeta; set (bound := _ + _ + 1e-200).
assert (U := u_value); assert (e := eta_pos); assert (small := eta_small); assert (l := least_small); assert (l0 := least_pos).
assert (r := R2_range radius radius_range); fold R2 in r; assert (G := fl_error R2); rewrite (Rabs_pos_eq R2) in G by lra; apply near in G; change (fl R2) with (square_fl radius) in G.
assert (Rs0 : 0 <= square_fl radius) by (apply fl_nonneg; fold R2; lra); assert (Rs13 : 0 <= square_fl radius <= 1e13) by (rewrite U in G; lra).
assert (Ds : double (square_fl radius)) by apply fl_double; assert (root0 := sqrt_pos q2).
assert (root : sqrt q2 <= 1e8) by (rewrite <- (sqrt_square 1e8) by lra; apply sqrt_le_1; lra).
assert (st : sqrt q2 * square_fl radius <= 151).
  assert (sqrt q2 * square_fl radius <= sqrt q2 * (R2 + u * R2 + eta)) by (apply Rmult_le_compat_l; lra).
  assert (sqrt q2 * eta <= 1e8 * eta) by (apply Rmult_le_compat_r; lra); fold R2 in steep; rewrite U in *; lra.
assert (qq : 0 <= q1 * q2 <= 4e15) by (split; [apply Rmult_le_pos; lra | apply Rle_trans with (4 * 1e15); [apply Rmult_le_compat; lra | lra]]).
assert (qR : 0 <= q1 * q2 * R2) by (apply Rmult_le_pos; lra); assert (X0 : 0 <= sqrt q2 * R2) by (apply Rmult_le_pos; lra).
assert (spare0 : 0 <= spare) by (unfold spare; apply Rmult_le_pos; [apply Rmult_le_pos; lra | lra]).
assert (sE : 0 <= spare * E) by (apply Rmult_le_pos; lra); assert (rim : 0 <= q1 * q2 * R2 * radius) by (apply Rmult_le_pos; lra).
assert (bound_is : bound = gradient_error_fl + (spare * E + 2.5e-15 * (q1 * q2 * R2 * radius)) + 1e-200) by (unfold bound, spare; ring).
destruct same_ends as [low_is top_is].
assert (C := fun D => ends_close radius d 0 E radius_range d_range (Rle_refl 0) (proj1 E_range) ltac:(lra) D); cbv zeta in C.
replace (2 * 0 + E) with E in C by ring; fold n R2 in C; rewrite <- low_is, <- top_is in C; fold w in C.
assert (n0 : 0 <= n) by apply Rmax_l; assert (nn : 0 <= n * n) by (apply Rmult_le_pos; exact n0).
assert (nF : n * n <= (d + E) * (d + E)).
  assert (n <= d + E) by (unfold n; apply Rmax_lub; lra); apply Rmult_le_compat; lra.
assert (nd : n * n <= d * d) by (assert (n <= d) by (unfold n; apply Rmax_lub; lra); apply Rmult_le_compat; lra).
destruct (steepest q2_pos) as [star [star0 [turns _]]].
destruct (single_peak q1_nonneg q2_pos star0 turns (proj1 r)) as [hat [hin is_peak]].
assert (H := gradient_error q1_nonneg q2_pos is_peak (proj1 d_range) length_is (proj1 E_range) wrong_by); cbv zeta in H; fold n in H.
destruct (Rle_dec (R2 - n * n) 0) as [out | inn]; simpl in H.
  rewrite !Rmult_0_l in H; apply Rle_trans with (1 := H); apply Rle_0_sqr.
unfold gradient_error_fl in bound_is; destruct (Rle_dec most_slack_fl 0) as [none | some].
  assert (few : R2 - n * n <= w).
    assert (c := C (n * n) (conj (Rle_refl _) nF) ltac:(lra)); apply Rabs_le_inv in c; lra.
  assert (A := gradient_small (plus r0 w0) not_nearer few); assert (B := gradient_small r0 ltac:(rewrite length_is; exact nd) few).
  apply Rle_trans with (1 := sq_minus_le _ _); set (t := q1 * q2 * w * radius) in *.
  assert (t0 : 0 <= t) by (unfold t, w; repeat apply Rmult_le_pos; lra).
  assert (tt : 2 * t <= bound).
    assert (tq : q1 * q2 * radius * eta <= 4e15 * 1e6 * eta) by (apply Rmult_le_compat_r; [lra | apply Rmult_le_compat; lra]).
    assert (T := least_is 1e30 ltac:(lra)); rewrite bound_is; unfold t, w; lra.
  assert (2 * t * (2 * t) <= bound * bound) by (apply Rmult_le_compat; lra); lra.
set (low := Rmax 0 (R2 - (d + E) * (d + E))) in *; assert (low0 : 0 <= low) by apply Rmax_l; assert (low1 : R2 - (d + E) * (d + E) <= low) by apply Rmax_r.
assert (low2 : low <= R2 - n * n) by (unfold low; apply Rmax_lub; lra).
assert (each : forall s, low <= s <= R2 - n * n ->
  curvature.K q1 q2 R2 s * E <= bound_fl (square_fl radius) least_slack_fl most_slack_fl E + spare * E + 1e-230 /\
  swell q1 q2 R2 s * E <= bound_fl (square_fl radius) least_slack_fl most_slack_fl E + spare * E + 1e-230).
  intros s sin; assert (c := C (R2 - s) ltac:(lra) ltac:(lra)); replace (R2 - (R2 - s)) with s in c by ring; destruct c as [order [top gap]].
  assert (cin := closest_in s _ _ (proj2 order)); set (a := closest s least_slack_fl most_slack_fl) in *.
  destruct (larger_enough (square_fl radius) Rs13 Ds st least_slack_fl most_slack_fl a E (proj1 order) cin top ltac:(lra)) as [L1 L2].
  assert (K1 := K_moved q1 q2 q1_range q2_range radius radius_range s a ltac:(fold R2; lra) ltac:(lra) gap); fold R2 in K1; fold spare in K1.
  assert (S1 := swell_moved s a ltac:(lra) ltac:(lra) gap).
  assert (K2 := Rmult_le_compat_r E _ _ (proj1 E_range) K1); assert (S2 := Rmult_le_compat_r E _ _ (proj1 E_range) S1).
  split; lra.
assert (cl : low <= Rmax low (Rmin (R2 - n * n) hat) <= R2 - n * n).
  split; [apply Rmax_l | apply Rmax_lub; [exact low2 | apply Rmin_l]].
assert (A := proj1 (each _ cl)); assert (B := proj2 (each low ltac:(lra))).
set (M := Rmax _ (swell q1 q2 R2 low)) in H; assert (M0 : 0 <= M).
  apply Rle_trans with (2 := Rmax_l _ _), (K_nonneg q1 q2 R2 q1_range q2_range); lra.
assert (ME : M * E <= bound).
  unfold M, Rmax at 1; destruct (Rle_dec _ _); rewrite bound_is; lra.
assert (ME0 : 0 <= M * E) by (apply Rmult_le_pos; lra).
apply Rle_trans with (1 := H); replace (M * M * (E * E)) with (M * E * (M * E)) by ring; apply Rmult_le_compat; assumption.
Qed.
End Offset.
End Bound.
