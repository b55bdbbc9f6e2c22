(* The peak of K as the code finds and stores it (crates/core/src/controller/budget/curvature.rs: `Curvature::new`; docs/theory/weights.md, eq:curvature-bound).

   In words. The code begins with the peak of f from a rounded root and with R^2 as it is stored, halves 64 times with a rounded middle and a test of which every operation is rounded,
   and stores the lower end. 0 < q1 <= 4, 0 < q2 <= 1e15, R^2 is at most 1e13, and sqrt(q2) R^2 <= 151, which holds of whatever `budget` chooses (150, and what is rounded of it).

   `stored_peak`: K(s) <= (1 + 1e-13) K(stored peak) for every s from 0 to R^2.
   `kappa_enough`: so K(s) <= kappa + 1e-250 for every s between the two ends as they are stored. This is `bend_max_enough` without its condition on the stored peak.
   `kappa_from_distance`: and `bend_max_from_distance` without it: from a distance, a move and an error, K <= kappa + 1.2e-15 R^2 q1 q2 (3.2 + 6 sqrt(q2) R^2) + 1e-240 for every
   distance that the pair can have.

   Why. The halving ends with two points that are 1e-13/sqrt(q2) apart at most (`width`). At the lower one the test said yes and at the upper one no, so gap is at least - 1e-10 at
   the one and at most 1e-10 at the other (`test_near`). Below the lower one K rises but for a way of 3e-11/sqrt(q2) at most, above the upper one it falls but for such a way, and
   on these ways it changes by less than 1e-19 of itself. *)

From Coq Require Import ZArith Reals Lra Psatz Lia.
From Flocq.Core Require Import Core.
From Flocq Require Import Mult_error.
From Interval Require Import Tactic.
From Closeranks Require Import intervals weights curvature peak bend_peak rounding exponential weight_rounded link_rounded slope_rounded slope_max_rounded
  bend_rounded bend_max_rounded bend_gap bend_test_rounded.
Import ExactIntervals.
Local Open Scope R_scope.
Local Existing Instance prec_53.

(* The middle of two doubles, rounded. *)
Definition middle a b := fl (/ 2 * fl (a + b)).

Lemma fl_same a : double a -> fl a = a.
Proof. intro D; apply round_generic; [apply valid_rnd_N | exact D]. Qed.

Lemma twice a : double a -> fl (a + a) = a + a.
Proof.
intro D; apply fl_same; replace (a + a) with (a * bpow radix2 1) by (replace (bpow radix2 1) with 2 by reflexivity; lra); apply mult_bpow_pos_exact_FLT; [exact D | lia].
Qed.

Lemma middle_between a b : double a -> double b -> a <= b -> a <= middle a b <= b.
Proof.
intros Da Db ab; unfold middle; assert (low : a + a <= fl (a + b)) by (rewrite <- twice by exact Da; apply fl_mono; lra).
assert (high : fl (a + b) <= b + b) by (rewrite <- twice by exact Db; apply fl_mono; lra).
split; [rewrite <- (fl_same a Da) at 1 | rewrite <- (fl_same b Db) at 2]; apply fl_mono; lra.
Qed.

Lemma middle_near a b : 0 <= a <= b -> Rabs (middle a b - (a + b) / 2) <= 2.01 * u * b + 2 * eta.
Proof.
intro ab; assert (U := u_value); assert (n := eta_pos); unfold middle.
assert (F := fl_error (a + b)); rewrite (Rabs_pos_eq (a + b)) in F by lra.
assert (D : Rabs (/ 2 * fl (a + b) - (a + b) / 2) <= (u * (a + b) + eta) / 2).
  replace (_ - _) with (/ 2 * (fl (a + b) - (a + b))) by field; rewrite Rabs_mult, (Rabs_pos_eq (/ 2)) by lra; lra.
apply Rle_trans with (1 := fl_of _ _ _ ((a + b) / 2) D ltac:(rewrite Rabs_pos_eq; lra)); rewrite U; lra.
Qed.

Section Peak.
Variables q1 q2 R2 : R.
Hypothesis q1_range : 0 < q1 <= 4.
Hypothesis q2_range : 0 < q2 <= 1e15.
Hypothesis R2_range : 0 <= R2 <= 1e13.
Hypothesis R2_double : double R2.
Hypothesis steep : sqrt q2 * R2 <= 151.
Variable far : R -> R.
Hypothesis far_range : forall x, 0 <= far x <= 0.05.
Let K := curvature.K q1 q2 R2.
Let r := sqrt q2.
Let rises := rises_fl q2 R2 far.
Let gap_at s := gap (r * R2) (r * s).

Fixpoint halvings n (lo hi : R) := match n with O => (lo, hi) | S n =>
  let m := middle lo hi in
  if Rlt_dec (fl (3 * excess_fl q2 far m)) (fl (ahead_fl q2 R2 m * bracket_fl q2 far m)) then halvings n m hi else halvings n lo m end.
Definition sharpest_fl := let low := steepest_fl q2 in if Rle_dec R2 low then R2 else fst (halvings 64 low R2).

(* What is true of the two ends. *)
Definition ends lo hi := steepest_fl q2 <= lo <= hi /\ hi <= R2 /\ double lo /\ double hi /\ (lo = steepest_fl q2 \/ rises lo) /\ (hi = R2 \/ ~ rises hi).

Lemma steepest_nonneg : 0 <= steepest_fl q2.
Proof. apply fl_nonneg, sqrt_pos. Qed.

Lemma halved n : forall lo hi, ends lo hi -> let e := halvings n lo hi in
  ends (fst e) (snd e) /\ snd e - fst e <= (hi - lo) * (/ 2) ^ n + (4.02 * u * R2 + 4 * eta) * (1 - (/ 2) ^ n).
Proof.
assert (s0 := steepest_nonneg); assert (U := u_value); assert (n0 := eta_pos).
induction n as [| n IH]; intros lo hi E; [cbn [halvings pow]; cbv zeta; cbn [fst snd]; split; [exact E | lra] |].
cbn [halvings]; cbv zeta; destruct E as [in_order [top [Dl [Dh [yes no]]]]]; set (m := middle lo hi) in *.
assert (b := middle_between lo hi Dl Dh ltac:(lra)); fold m in b; assert (N := middle_near lo hi ltac:(lra)); fold m in N; apply near in N.
assert (Dm : double m) by apply fl_double; assert (uh : u * hi <= u * R2) by (apply Rmult_le_compat_l; [rewrite U |]; lra).
assert (p0 : 0 < (/ 2) ^ n) by (apply pow_lt; lra); cbn [pow]; set (p := (/ 2) ^ n) in *.
assert (shrink : forall w, w <= (hi - lo) / 2 + (2.01 * u * R2 + 2 * eta) ->
  w * p + (4.02 * u * R2 + 4 * eta) * (1 - p) <= (hi - lo) * (/ 2 * p) + (4.02 * u * R2 + 4 * eta) * (1 - / 2 * p)).
  intros w small; assert (w * p <= ((hi - lo) / 2 + (2.01 * u * R2 + 2 * eta)) * p) by (apply Rmult_le_compat_r; lra); lra.
destruct (Rlt_dec _ _) as [up | down].
  destruct (IH m hi) as [E W]; [repeat split; try assumption; try lra; right; exact up |].
  split; [exact E | apply Rle_trans with (1 := W), shrink; lra].
destruct (IH lo m) as [E W]; [repeat split; try assumption; try lra; right; exact down |].
split; [exact E | apply Rle_trans with (1 := W), shrink; lra].
Qed.

Variable star : R.
Hypothesis star_nonneg : 0 <= star.
Hypothesis turns : turn q2 star = 1.
Hypothesis star_is : Rabs (q2 * (star * star) / 2 - steepest_z) <= 1 / 10 ^ 15.

Lemma r_pos : 0 < r <= 1e8.
Proof.
split; [apply sqrt_lt_R0; lra |]; unfold r; rewrite <- (sqrt_square 1e8) by lra; apply sqrt_le_1; lra.
Qed.
Lemma r_mono a b : a <= b -> r * a <= r * b.
Proof. assert (r0 := r_pos); apply Rmult_le_compat_l; lra. Qed.

Lemma star_x : 1.0215 <= r * star <= 1.0217.
Proof.
assert (r0 := r_pos); assert (Z := near _ _ _ star_is); unfold steepest_z in Z.
assert (sq := square_is q2 (proj1 q2_range) star); fold r in sq; assert (x0 : 0 <= r * star) by (apply Rmult_le_pos; lra); set (x := r * star) in *.
split.
  destruct (Rle_lt_dec 1.0215 x) as [le | lt]; [exact le | exfalso].
  assert (x * x <= 1.0215 * 1.0215) by (apply Rmult_le_compat; lra); lra.
destruct (Rle_lt_dec x 1.0217) as [le | lt]; [exact le | exfalso].
assert (1.0217 * 1.0217 <= x * x) by (apply Rmult_le_compat; lra); lra.
Qed.

Lemma steepest_x : Rabs (r * steepest_fl q2 - r * star) <= 2.8e-15.
Proof.
assert (N := steepest_near q2 q2_range star star_nonneg turns star_is); assert (X := star_x); assert (r0 := r_pos).
rewrite <- Rmult_minus_distr_l, Rabs_mult, (Rabs_pos_eq r) by lra.
apply Rle_trans with (r * (2.7e-15 * star)); [apply Rmult_le_compat_l; lra | lra].
Qed.

Lemma K_pos s : star <= s <= R2 -> 0 <= K s.
Proof.
intro sin; assert (q1_nonneg : 0 <= q1) by lra; assert (L := K_front q1 q2 R2 q1_nonneg (proj1 q2_range) star star_nonneg turns s sin).
assert (F := @front_nonneg q1 q2 q1_nonneg (proj1 q2_range) s); apply Rle_trans with (2 := L); apply Rmult_le_pos; lra.
Qed.

Lemma before_star s : 0 <= s <= star -> K s <= K star.
Proof. intro sin; apply (up_before R2 (Rlt_le _ _ (proj1 q1_range)) (proj1 q2_range) turns); lra. Qed.

Lemma star_to l : steepest_fl q2 <= l <= star -> K star <= (1 + 7e-15) * K l.
Proof.
intro lin; assert (s0 := steepest_nonneg); assert (q1_nonneg : 0 <= q1) by lra.
assert (M := peak_moved q1 q2 q1_range q2_range star l star star star_nonneg turns star_is ltac:(lra) ltac:(lra)).
assert (is : closest (steepest_fl q2) l star = l).
  unfold closest; destruct (Rlt_dec (steepest_fl q2) l); [reflexivity | destruct (Rlt_dec star (steepest_fl q2)); lra].
rewrite is in M; unfold K; assert (T := @T_before q2 (proj1 q2_range) star turns l ltac:(lra)); cbv beta in T.
rewrite (K_before R2 q1_nonneg (proj1 q2_range) T), (K_before R2 q1_nonneg (proj1 q2_range) (Req_le _ _ turns)); lra.
Qed.

(* Next to the peak of f, which is stored if there is nothing to halve. *)
Lemma near_start s l : star <= s <= l -> l <= steepest_fl q2 -> l <= R2 -> K s <= (1 + 5e-14) * K l.
Proof.
intros sin ls lR; assert (N := near _ _ _ steepest_x); assert (X := star_x); assert (r0 := r_pos); assert (ls' := r_mono _ _ ls).
assert (ss := r_mono star s ltac:(lra)); assert (sl := r_mono s l ltac:(lra)); assert (q1_nonneg : 0 <= q1) by lra; assert (lR' := r_mono _ _ lR).
assert (D := step_down q1 q2 R2 q1_nonneg (proj1 q2_range) star star_nonneg turns s l 2 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(fold r; lra) ltac:(fold r; lra) ltac:(lra)).
fold r K in D; apply Rle_trans with ((1 + 7 * 2 * (r * (l - s))) * K l).
  apply D; intros c cin; assert (cx := r_mono s c ltac:(lra)); assert (cl := r_mono c l ltac:(lra)).
  assert (P := push_high (r * c) ltac:(lra)); assert (T := excess_early (r * c) ltac:(lra)).
  assert (0 <= (r * R2 - r * c) * push (r * c)) by (apply Rmult_le_pos; lra); unfold gap; lra.
apply Rmult_le_compat_r; [apply K_pos; lra | lra].
Qed.

(* 3e-11 without units. *)
Let d := 3e-11 / r.
Lemma d_is : 0 < d /\ r * d = 3e-11.
Proof.
assert (r0 := r_pos); split; [unfold d, Rdiv; apply Rmult_lt_0_compat; [lra | apply Rinv_0_lt_compat; lra] | unfold d; field; lra].
Qed.

(* Below an end of which the test said yes. *)
Lemma below l s : star <= s <= l -> l <= R2 -> rises l -> K s <= (1 + 1e-19) * K l.
Proof.
intros sin lR yes; assert (X := star_x); assert (r0 := r_pos); destruct d_is as [d0 dx]; assert (q1_nonneg : 0 <= q1) by lra.
assert (ss := r_mono star s ltac:(lra)); assert (sl := r_mono s l ltac:(lra)); assert (lR' := r_mono _ _ lR).
assert (l1 : r * l < 1.62).
  destruct (Rle_lt_dec 1.62 (r * l)) as [beyond | lt]; [exfalso | exact lt].
  exact (test_far q2 R2 q2_range R2_range steep far far_range l ltac:(lra) beyond yes).
assert (G := proj1 (test_near q2 R2 q2_range R2_range steep far l ltac:(lra) ltac:(fold r; lra)) yes); fold r in G.
assert (falls : forall c, star <= c <= l -> gap_at c <= 0.01 -> gap_at l <= gap_at c - 4 * (r * l - r * c)).
  intros c cin; assert (cs := r_mono star c ltac:(lra)); assert (cl := r_mono c l ltac:(lra)); apply gap_falls; lra.
assert (last : forall a, star <= a -> l - d <= a <= l -> K a <= (1 + 2.2e-20) * K l).
  intros a sa ain; assert (ax := r_mono star a ltac:(lra)); assert (al := r_mono (l - d) a ltac:(lra)).
  assert (D := step_down q1 q2 R2 q1_nonneg (proj1 q2_range) star star_nonneg turns a l 1e-10 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(fold r; lra) ltac:(fold r; lra) ltac:(lra)).
  fold r K in D; apply Rle_trans with ((1 + 7 * 1e-10 * (r * (l - a))) * K l).
    apply D; intros c cin; change (- (1e-10) <= gap_at c); destruct (Rle_lt_dec (- 1e-10) (gap_at c)) as [le | lt]; [lra | exfalso].
    assert (cl := r_mono c l ltac:(lra)); assert (F := falls c ltac:(lra) ltac:(lra)); unfold gap_at at 1 in F; lra.
  apply Rmult_le_compat_r; [apply K_pos; lra | lra].
assert (Kl := K_pos l ltac:(lra)); destruct (Rle_lt_dec (l - d) s) as [close | apart_]; [assert (H := last s ltac:(lra) ltac:(lra)); lra |].
assert (H := last (l - d) ltac:(lra) ltac:(lra)).
assert (D := step_down q1 q2 R2 q1_nonneg (proj1 q2_range) star star_nonneg turns s (l - d) 0 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(fold r; lra) ltac:(fold r; lra) ltac:(lra)).
fold K in D; assert (U : K s <= K (l - d)).
  replace (K (l - d)) with ((1 + 7 * 0 * (sqrt q2 * (l - d - s))) * K (l - d)) by ring.
  apply D; intros c cin; change (- 0 <= gap_at c); destruct (Rle_lt_dec 0 (gap_at c)) as [le | lt]; [lra | exfalso].
  assert (cl := r_mono c (l - d) ltac:(lra)); assert (F := falls c ltac:(lra) ltac:(lra)); unfold gap_at at 1 in F; lra.
lra.
Qed.

(* Above an end of which the test said no. *)
Lemma above h m s : 1.02 <= r * h -> h <= m -> star <= m -> m <= s <= R2 -> ~ rises h -> K s <= (1 + 1e-19) * K m.
Proof.
intros h1 hm sm sin no; assert (X := star_x); assert (r0 := r_pos); destruct d_is as [d0 dx]; assert (q1_nonneg : 0 <= q1) by lra.
assert (s0 : 0 <= h) by (destruct (Rle_lt_dec 0 h) as [le | lt]; [exact le | assert (r * h <= r * 0) by (apply r_mono; lra); lra]).
assert (all : forall c, m < c <= R2 -> gap_at c <= 1e-10 /\ (m + d <= c -> gap_at c <= 0)).
  intros c cin; assert (hc := r_mono h c ltac:(lra)); assert (cR := r_mono c R2 ltac:(lra)).
  destruct (Rle_lt_dec 1.62 (r * c)) as [beyond | lt].
    assert (B := gap_beyond (r * R2) (r * c) beyond cR); fold (gap_at c) in B; split; [lra | intros _; exact B].
  assert (G := proj2 (test_near q2 R2 q2_range R2_range steep far h ltac:(lra) ltac:(fold r; lra)) no); fold r in G.
  assert (F := gap_falls (r * R2) (r * h) (r * c) h1 hc ltac:(lra) cR ltac:(lra)); fold (gap_at c) in F; split; [lra |].
  intro more; assert (M := r_mono (h + d) c ltac:(lra)); lra.
assert (ms := r_mono star m sm).
assert (first : forall b, m <= b <= m + d -> b <= R2 -> K b <= (1 + 4e-21) * K m).
  intros b bin bR; assert (bm := r_mono b (m + d) ltac:(lra)).
  assert (S := step_up q1 q2 R2 q1_nonneg (proj1 q2_range) star star_nonneg turns m b 1e-10 sm ltac:(lra) bR ltac:(fold r; lra) ltac:(lra)).
  fold r K in S; apply Rle_trans with ((1 + 1e-10 * (r * (b - m))) * K m).
    apply S; intros c cin; apply all; lra.
  apply Rmult_le_compat_r; [apply K_pos; lra | lra].
assert (Km := K_pos m ltac:(lra)); destruct (Rle_lt_dec s (m + d)) as [close | apart_]; [assert (H := first s ltac:(lra) ltac:(lra)); lra |].
assert (H := first (m + d) ltac:(lra) ltac:(lra)); assert (mx := r_mono m (m + d) ltac:(lra)).
assert (S := step_up q1 q2 R2 q1_nonneg (proj1 q2_range) star star_nonneg turns (m + d) s 0 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(fold r; lra) ltac:(lra)).
fold K in S; assert (U : K s <= K (m + d)).
  replace (K (m + d)) with ((1 + 0 * (sqrt q2 * (s - (m + d)))) * K (m + d)) by ring.
  apply S; intros c cin; apply all; lra.
lra.
Qed.

(* Between the two ends. *)
Lemma inside p h s : star <= p -> p <= s <= h -> h <= R2 -> r * (h - p) <= 1e-13 -> (h = R2 \/ ~ rises h) -> K s <= (1 + 1e-19) * K p.
Proof.
intros sp sin hR small which; assert (X := star_x); assert (r0 := r_pos); assert (q1_nonneg : 0 <= q1) by lra; assert (px := r_mono star p sp).
assert (S := step_up q1 q2 R2 q1_nonneg (proj1 q2_range) star star_nonneg turns p s 1e-8 sp ltac:(lra) ltac:(lra) ltac:(fold r; lra) ltac:(lra)).
fold r K in S; assert (sh := r_mono s h ltac:(lra)); assert (hR' := r_mono h R2 hR); apply Rle_trans with ((1 + 1e-8 * (r * (s - p))) * K p).
  apply S; intros c cin; assert (pc := r_mono p c ltac:(lra)); assert (ch := r_mono c h ltac:(lra)).
  destruct (Rle_lt_dec 1.62 (r * c)) as [beyond | lt].
    assert (B := gap_beyond (r * R2) (r * c) beyond ltac:(lra)); lra.
  destruct which as [top | no].
    assert (T := @T_after q2 (proj1 q2_range) star star_nonneg turns c ltac:(lra)); cbv beta in T; assert (E := excess_is q2 (proj1 q2_range) c); fold r in E.
    assert (P := push_range (r * c) ltac:(lra)); unfold gap; rewrite E.
    assert ((r * R2 - r * c) * push (r * c) <= 1e-13 * 4).
      apply Rle_trans with ((r * R2 - r * c) * 4); [apply Rmult_le_compat_l; lra | rewrite <- top; lra].
    lra.
  assert (G := proj2 (test_near q2 R2 q2_range R2_range steep far h ltac:(lra) ltac:(fold r; lra)) no); fold r in G.
  assert (F := gap_steep (r * R2) (r * c) (r * h) ltac:(lra) ch ltac:(lra) hR' ltac:(unfold r; lra)); lra.
apply Rmult_le_compat_r; [apply K_pos; lra | lra].
Qed.

Lemma width l h : r * steepest_fl q2 <= r * R2 -> h - l <= (R2 - steepest_fl q2) * (/ 2) ^ 64 + (4.02 * u * R2 + 4 * eta) * (1 - (/ 2) ^ 64) -> r * (h - l) <= 1e-13.
Proof.
intros order W; assert (r0 := r_pos); assert (U := u_value); assert (n := eta_small); assert (l0 := least_small); assert (n0 := eta_pos); assert (s0 := steepest_nonneg).
assert (p0 : 0 <= (/ 2) ^ 64 <= 1e-19) by lra; set (p := (/ 2) ^ 64) in *; assert (rW := r_mono _ _ W).
assert (rs : 0 <= r * steepest_fl q2) by (apply Rmult_le_pos; lra).
assert (a : r * (R2 - steepest_fl q2) * p <= 151 * 1e-19) by (apply Rmult_le_compat; unfold r in *; lra).
assert (re : r * eta <= 1e8 * eta) by (apply Rmult_le_compat_r; lra).
assert (w0 : 0 <= r * R2 <= 151) by (split; [apply Rmult_le_pos; lra | exact steep]).
assert (re0 : 0 <= r * eta) by (apply Rmult_le_pos; lra).
assert (b : (4.02 * u * (r * R2) + 4 * (r * eta)) * (1 - p) <= (4.02 * u * 151 + 4 * (1e8 * eta)) * 1).
  apply Rmult_le_compat; try rewrite U; lra.
rewrite U in *; lra.
Qed.

Lemma stored_of_star s : 0 <= s <= R2 -> K s <= (1 + 1e-13) * K sharpest_fl.
Proof.
intro sin; assert (X := star_x); assert (N := near _ _ _ steepest_x); assert (r0 := r_pos); unfold sharpest_fl; cbv zeta; set (low := steepest_fl q2) in *.
destruct (Rle_dec R2 low) as [none | some].
  destruct (Rle_lt_dec R2 star) as [le | lt].
    assert (B := up_before R2 (Rlt_le _ _ (proj1 q1_range)) (proj1 q2_range) turns (proj1 sin) (proj2 sin) le); fold K in B.
    assert (0 <= K R2); [| lra].
    assert (T := @T_before q2 (proj1 q2_range) star turns R2 ltac:(lra)); cbv beta in T; unfold K; rewrite (K_before R2 (Rlt_le _ _ (proj1 q1_range)) (proj1 q2_range) T).
    assert (0 <= f q1 q2 R2) by (apply f_nonneg; lra); lra.
  assert (KR := K_pos R2 ltac:(lra)); destruct (Rle_lt_dec s star) as [ss | ss].
    assert (B := before_star s ltac:(lra)); assert (D := near_start star R2 ltac:(lra) none ltac:(lra)); lra.
  assert (D := near_start s R2 ltac:(lra) none ltac:(lra)); lra.
assert (start : ends low R2).
  unfold ends; fold low; split; [lra | split; [lra | split; [apply fl_double | split; [exact R2_double | split; left; reflexivity]]]].
destruct (halved 64 low R2 start) as [E W]; set (e := halvings 64 low R2) in *; set (l := fst e) in *; set (h := snd e) in *.
assert (small := width l h (r_mono low R2 ltac:(lra)) W); destruct E as [in_order [hR [_ [_ [yes no]]]]]; fold low in in_order, yes.
assert (lx := r_mono low l ltac:(lra)); assert (lh := r_mono l h ltac:(lra)).
(* From l to the peak of f, where l is below it. *)
set (p := Rmax l star); assert (p1 : l <= p) by apply Rmax_l; assert (p2 : star <= p) by apply Rmax_r.
assert (first : p <= R2 -> K p <= (1 + 7e-15) * K l).
  intro pR; unfold p, Rmax in *; destruct (Rle_dec l star) as [le | gt]; [apply star_to; fold low; lra |].
  assert (Kl := K_pos l ltac:(lra)); lra.
assert (s0 := steepest_nonneg); fold low in s0.
assert (Kl0 : 0 <= K l).
  destruct (Rle_lt_dec star l) as [le | lt]; [apply K_pos; lra |].
  assert (T := @T_before q2 (proj1 q2_range) star turns l ltac:(lra)); cbv beta in T.
  unfold K; rewrite (K_before R2 (Rlt_le _ _ (proj1 q1_range)) (proj1 q2_range) T); assert (0 <= f q1 q2 l) by (apply f_nonneg; lra); lra.
destruct (Rle_lt_dec s star) as [ss | ss].
  assert (B := before_star s ltac:(lra)); destruct (Rle_lt_dec l star) as [le | lt].
    assert (H := star_to l ltac:(fold low; lra)); lra.
  destruct yes as [is | up].
    assert (D := near_start star l ltac:(lra) ltac:(fold low; lra) ltac:(lra)); lra.
  assert (D := below l star ltac:(lra) ltac:(lra) up); lra.
destruct (Rle_lt_dec s l) as [sl | ls].
  destruct yes as [is | up].
    assert (D := near_start s l ltac:(lra) ltac:(fold low; lra) ltac:(lra)); lra.
  assert (D := below l s ltac:(lra) ltac:(lra) up); lra.
assert (ps : p <= s) by (unfold p; apply Rmax_lub; lra); assert (F := first ltac:(lra)); assert (Kp := K_pos p ltac:(lra)).
destruct (Rle_lt_dec s h) as [sh | hs].
  assert (ph : r * (h - p) <= 1e-13) by (assert (M := r_mono (h - p) (h - l) ltac:(lra)); lra).
  assert (I := inside p h s p2 ltac:(lra) hR ph no); lra.
destruct no as [top | no]; [lra |].
destruct (Rle_lt_dec p h) as [ph | hp].
  assert (small' : r * (h - p) <= 1e-13) by (assert (M := r_mono (h - p) (h - l) ltac:(lra)); lra).
  assert (I := inside p h h p2 ltac:(lra) hR small' (or_intror no)).
  assert (A := above h h s ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) no); lra.
assert (A := above h p s ltac:(lra) ltac:(lra) p2 ltac:(lra) no); lra.
Qed.
End Peak.

Theorem stored_peak q1 q2 R2 far : 0 < q1 <= 4 -> 0 < q2 <= 1e15 -> 0 <= R2 <= 1e13 -> double R2 -> sqrt q2 * R2 <= 151 -> (forall x, 0 <= far x <= 0.05) ->
  forall s, 0 <= s <= R2 -> curvature.K q1 q2 R2 s <= (1 + 1e-13) * curvature.K q1 q2 R2 (sharpest_fl q2 R2 far).
Proof.
intros a b c D e F s sin; destruct (steepest (proj1 b)) as [star [star0 [turns Z]]].
exact (stored_of_star q1 q2 R2 a b c D e far F star star0 turns Z s sin).
Qed.

Lemma stored_range q2 R2 far : 0 <= R2 <= 1e13 -> double R2 -> 0 <= sharpest_fl q2 R2 far <= R2.
Proof.
intros c D; unfold sharpest_fl; cbv zeta; assert (s0 := steepest_nonneg q2); destruct (Rle_dec _ _) as [_ | some]; [lra |].
assert (start : ends q2 R2 far (steepest_fl q2) R2).
  unfold ends; split; [lra | split; [lra | split; [apply fl_double | split; [exact D | split; left; reflexivity]]]].
destruct (halved q2 R2 far 64 _ _ start) as [[in_order [hR _]] _]; lra.
Qed.

Section Kappa.
Variables q1 q2 : R.
Hypothesis q1_range : 0 < q1 <= 4.
Hypothesis q2_range : 0 < q2 <= 1e15.
Variable far : R -> R.
Hypothesis far_range : forall x, 0 <= far x <= 0.05.
Lemma far_nonneg x : 0 <= far x. Proof. apply far_range. Qed.

Theorem kappa_enough R2 lo hi s : 0 <= R2 <= 1e13 -> double R2 -> sqrt q2 * R2 <= 151 -> 0 <= lo -> lo <= s <= hi -> hi <= R2 ->
  curvature.K q1 q2 R2 s <= bend_max_fl q1 q2 R2 far (sharpest_fl q2 R2 far) lo hi + 1e-250.
Proof.
intros r D st lo0 sin hiR; destruct (steepest (proj1 q2_range)) as [star [star0 [turns _]]].
destruct (single_peak (Rlt_le _ _ (proj1 q1_range)) (proj1 q2_range) star0 turns (proj1 r)) as [hat [hin is_peak]].
apply (bend_max_enough q1 q2 R2 q1_range q2_range r st far far_nonneg (sharpest_fl q2 R2 far) hat is_peak); try assumption.
  apply stored_range; assumption.
apply stored_peak; assumption.
Qed.

Theorem kappa_from_distance radius d rho E D : 0 <= radius <= 1e6 -> sqrt q2 * (radius * radius) <= 150.5 -> 0 <= d <= 1e7 -> 0 <= rho -> 0 <= E -> 2 * rho + E <= radius ->
  let R2 := radius * radius in let n := Rmax 0 (d - (2 * rho + E)) in let f := d + (2 * rho + E) in n * n <= D <= f * f -> D <= R2 ->
  curvature.K q1 q2 R2 (R2 - D) <= bend_max q1 q2 far radius d rho E (sharpest_fl q2 (square_fl radius) far) + 1.2e-15 * R2 * (q1 * q2) * (3.2 + 6 * (sqrt q2 * R2)) + 1e-240.
Proof.
intros rad st dr rho0 E0 reach R2 n f Din DR; assert (U := u_value); assert (small := eta_small); assert (l := least_small); assert (n0 := eta_pos).
assert (r := R2_range radius rad); fold R2 in r, st; assert (G := fl_error R2); rewrite (Rabs_pos_eq R2) in G by lra; apply near in G.
assert (F0 : 0 <= fl R2) by (apply fl_nonneg; lra); assert (root0 := sqrt_pos q2).
assert (root : sqrt q2 <= 1e8) by (rewrite <- (sqrt_square 1e8) by lra; apply sqrt_le_1; lra).
assert (range : 0 <= square_fl radius <= 1e13) by (unfold square_fl; fold R2; rewrite U in G; lra).
assert (steep : sqrt q2 * square_fl radius <= 151).
  unfold square_fl; fold R2; assert (sqrt q2 * fl R2 <= sqrt q2 * (R2 + u * R2 + eta)) by (apply Rmult_le_compat_l; lra).
  assert (sqrt q2 * eta <= 1e8 * eta) by (apply Rmult_le_compat_r; lra); rewrite U in *; lra.
assert (Ds : double (square_fl radius)) by apply fl_double.
destruct (steepest (proj1 q2_range)) as [star [star0 [turns _]]].
destruct (single_peak (Rlt_le _ _ (proj1 q1_range)) (proj1 q2_range) star0 turns (proj1 range)) as [hat [hin is_peak]].
apply (bend_max_from_distance q1 q2 q1_range q2_range far far_nonneg radius d rho E rad st dr rho0 E0 reach (sharpest_fl q2 (square_fl radius) far) hat is_peak); try assumption.
  apply stored_range; assumption.
apply stored_peak; assumption.
Qed.
End Kappa.
