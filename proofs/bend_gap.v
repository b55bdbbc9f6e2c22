(* How K rises and falls near its peak, without units (docs/theory/weights.md, eq:curvature-bound).

   In words. With x = sqrt(q2) s, X = sqrt(q2) R^2 and h = tanh(x^2/2), let t(x) = 2 x^2 h - 1, B(x) = 4 (h + x^2/2 (1 - h^2)) - 2 h t and
   gap(x) = 2 (X - x) x B(x) - 3 t(x). Above the peak of f the slope of K is a positive number times gap (`slope_gap`), so the code's test of one s asks whether gap is positive.

   `gap_falls`: from x = 1.02 on, which is below the peak of f, gap falls by at least 4 for each unit of x once it is at most 0.01. So where gap is wrong by
   little, the place where it changes its sign is moved by little.
   `gap_beyond`: from x = 1.62 on, gap is not positive.
   `gap_steep`: for X <= 151 it changes by at most 9400 for each unit of x.
   `step_up`, `step_down`: what a bound of gap between two points says of K at them. *)

From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
From Closeranks Require Import intervals weights curvature peak bend_peak.
Import ExactIntervals.
Local Open Scope R_scope.

Definition tanh_half x := (1 - exp (- (x * x))) / (1 + exp (- (x * x))).
Definition excess x := 2 * (x * x) * tanh_half x - 1.
Definition bracket x := 4 * (tanh_half x + x * x / 2 * (1 - tanh_half x * tanh_half x)) - 2 * tanh_half x * excess x.
Definition push x := x * bracket x.
Definition gap X x := 2 * (X - x) * push x - 3 * excess x.

(* Slopes of the three. *)
Definition tanh_slope x := x * (1 - tanh_half x * tanh_half x).
Definition excess_slope x := 4 * x * tanh_half x + 2 * (x * x) * tanh_slope x.
Definition push_slope x :=
  6 * tanh_half x + 6 * (x * x) + 6 * x * (1 - 2 * (x * x) * tanh_half x) * tanh_slope x - 18 * (x * x) * (tanh_half x * tanh_half x).

Lemma excess_derive x : is_derive excess x (excess_slope x).
Proof.
assert (e0 := exp_pos (- (x * x))); unfold excess, excess_slope, tanh_slope, tanh_half; auto_derive; [lra | field; lra].
Qed.
Lemma push_derive x : is_derive push x (push_slope x).
Proof.
assert (e0 := exp_pos (- (x * x))); unfold push, bracket, excess, push_slope, tanh_slope, tanh_half; auto_derive; [lra | field; lra].
Qed.

(* Numbers about them. *)
Ltac spread_out := unfold push_slope, push, bracket, excess_slope, excess, tanh_slope, tanh_half.
Ltac by_intervals x := spread_out; interval with (i_bisect x, i_autodiff x, i_depth 20, i_prec 50).
Lemma excess_slope_range x : 1.02 <= x <= 1.65 -> 3.5 <= excess_slope x <= 8.
Proof. intros [a b]; split; by_intervals x. Qed.
Lemma push_slope_range x : 1.02 <= x <= 1.65 -> -31 <= push_slope x <= 5.
Proof. intros [a b]; split; by_intervals x. Qed.
Lemma push_falls x : 1.17 <= x <= 1.65 -> push_slope x <= 0.
Proof. intros [a b]; by_intervals x. Qed.
Lemma push_high x : 1.02 <= x <= 1.17 -> 3.5 <= push x.
Proof. intros [a b]; by_intervals x. Qed.
Lemma push_range x : 1.02 <= x <= 1.65 -> -3.1 <= push x <= 4.
Proof. intros [a b]; split; by_intervals x. Qed.
Lemma excess_early x : 1.02 <= x <= 1.17 -> excess x <= 0.63.
Proof. intros [a b]; by_intervals x. Qed.

Lemma mean_of f f1 a b : (forall x, is_derive f x (f1 x)) -> a <= b -> exists c, a <= c <= b /\ f b - f a = f1 c * (b - a).
Proof.
intros der [ab | ->]; [| exists b; split; [lra | ring]].
destruct (MVT_cor2 f f1 a b ab) as [c [is cin]]; [intros t _; apply is_derive_Reals, der |].
exists c; split; [lra | exact is].
Qed.

Section Two.
Variables X a b : R.
Hypothesis a_low : 1.02 <= a.
Hypothesis ordered : a <= b.
Hypothesis b_high : b <= 1.65.
Hypothesis within : b <= X.

Lemma apart : gap X b - gap X a = 2 * (X - b) * (push b - push a) - 2 * (b - a) * push a - 3 * (excess b - excess a).
Proof. unfold gap; ring. Qed.

Lemma excess_moved : 3.5 * (b - a) <= excess b - excess a <= 8 * (b - a).
Proof.
destruct (mean_of _ _ a b excess_derive ordered) as [c [cin ->]]; assert (r := excess_slope_range c ltac:(lra)).
split; apply Rmult_le_compat_r; lra.
Qed.
Lemma push_moved : -31 * (b - a) <= push b - push a <= 5 * (b - a).
Proof.
destruct (mean_of _ _ a b push_derive ordered) as [c [cin ->]]; assert (r := push_slope_range c ltac:(lra)).
split; apply Rmult_le_compat_r; lra.
Qed.

Theorem gap_falls : gap X a <= 0.01 -> gap X b <= gap X a - 4 * (b - a).
Proof.
intro low; assert (E := excess_moved); assert (P := push_moved); assert (A := apart); assert (Pa := push_range a ltac:(lra)).
assert (w := Rle_dec 1.17 a); destruct w as [late | early].
  assert (down : push b - push a <= 0).
    destruct (mean_of _ _ a b push_derive ordered) as [c [cin ->]]; assert (r := push_falls c ltac:(lra)).
    assert (0 <= - push_slope c * (b - a)) by (apply Rmult_le_pos; lra); lra.
  assert (p1 : 0 <= (X - b) * - (push b - push a)) by (apply Rmult_le_pos; lra).
  assert (p2 : 0 <= (b - a) * (push a + 3.1)) by (apply Rmult_le_pos; lra); lra.
assert (T := excess_early a ltac:(lra)); assert (H := push_high a ltac:(lra)).
assert (short : X - a <= 0.28).
  assert (p : (X - a) * 3.5 <= (X - a) * push a) by (apply Rmult_le_compat_l; lra); unfold gap in low; lra.
assert (p1 : (X - b) * (push b - push a) <= (X - b) * (5 * (b - a))) by (apply Rmult_le_compat_l; lra).
assert (p2 : (X - b) * (5 * (b - a)) <= 0.28 * (5 * (b - a))) by (apply Rmult_le_compat_r; lra).
assert (p3 : 0 <= (b - a) * (push a - 3.5)) by (apply Rmult_le_pos; lra); lra.
Qed.

Theorem gap_steep : X <= 151 -> gap X a <= gap X b + 9400 * (b - a).
Proof.
intro small; assert (E := excess_moved); assert (P := push_moved); assert (A := apart); assert (Pa := push_range a ltac:(lra)).
assert (p1 : (X - b) * (-31 * (b - a)) <= (X - b) * (push b - push a)) by (apply Rmult_le_compat_l; lra).
assert (p2 : (X - b) * (31 * (b - a)) <= 151 * (31 * (b - a))) by (apply Rmult_le_compat_r; lra).
assert (p3 : 0 <= (b - a) * (4 - push a)) by (apply Rmult_le_pos; lra); lra.
Qed.
End Two.

Lemma tanh_half_range x : 1.62 <= x -> 0.864 <= tanh_half x <= 1.
Proof.
intro x1; unfold tanh_half; assert (e0 := exp_pos (- (x * x))); set (e := exp (- (x * x))) in *.
assert (e1 : e <= 0.0725).
  apply Rle_trans with (exp (- (1.62 * 1.62))); [| interval with (i_prec 60)].
  assert (1.62 * 1.62 <= x * x) by (apply Rmult_le_compat; lra).
  unfold e; destruct (Req_dec (x * x) (1.62 * 1.62)) as [-> | ne]; [lra | apply Rlt_le, exp_increasing; lra].
unfold Rdiv; split; apply Rmult_le_reg_r with (1 + e); try lra; rewrite Rmult_assoc, Rinv_l by lra; lra.
Qed.

Theorem gap_beyond X x : 1.62 <= x -> x <= X -> gap X x <= 0.
Proof.
intros x1 xX; assert (h := tanh_half_range x x1); unfold gap, push, bracket, excess; set (t := tanh_half x) in *; set (z := x * x).
assert (z1 : 2.62 <= z) by (unfold z; apply Rle_trans with (1.62 * 1.62); [lra | apply Rmult_le_compat; lra]).
assert (tt : 0.746 <= t * t) by (apply Rle_trans with (0.864 * 0.864); [lra | apply Rmult_le_compat; lra]).
assert (zt : 2.62 * 0.864 <= z * t) by (apply Rmult_le_compat; lra).
assert (ztt : z * 0.746 <= z * (t * t)) by (apply Rmult_le_compat_l; lra).
assert (neg : 0 <= - (4 * (t + z / 2 * (1 - t * t)) - 2 * t * (2 * z * t - 1))) by lra.
assert (p : 0 <= (X - x) * (x * - (4 * (t + z / 2 * (1 - t * t)) - 2 * t * (2 * z * t - 1)))) by (apply Rmult_le_pos; [lra | apply Rmult_le_pos; lra]).
lra.
Qed.

(* K in its own units. *)
Section Steps.
Variables q1 q2 R2 : R.
Hypothesis q1_nonneg : 0 <= q1.
Hypothesis q2_pos : 0 < q2.
Let r := sqrt q2.
Let K := curvature.K q1 q2 R2.
Let front := bend_peak.front q1 q2.
Let gap_at s := gap (r * R2) (r * s).

Lemma root_pos : 0 < r. Proof. apply sqrt_lt_R0; exact q2_pos. Qed.
Lemma root_square : r * r = q2. Proof. apply sqrt_sqrt; lra. Qed.
Lemma square_is s : r * s * (r * s) = q2 * (s * s). Proof. rewrite <- root_square; ring. Qed.

Lemma excess_is s : excess (r * s) = turn q2 s - 1.
Proof.
assert (T := T_tanh q2 s); cbv beta in T; rewrite T; unfold excess, tanh_half, tanh'; rewrite square_is; ring.
Qed.

Theorem slope_gap s : K2' q1 q2 R2 s = 2 * front s * gap_at s.
Proof.
assert (e0 := exp_pos (- (q2 * (s * s)))); unfold K2', g1, g, gap_at, gap; fold (front s).
rewrite excess_is; unfold push, bracket; rewrite excess_is; unfold T1, tanh_half; rewrite square_is; fold (tanh' q2 s).
assert (part : 4 * q2 * s * exp (- (q2 * (s * s))) / ((1 + exp (- (q2 * (s * s)))) * (1 + exp (- (q2 * (s * s))))) = q2 * s * (1 - tanh' q2 s * tanh' q2 s)).
  unfold tanh'; field; lra.
rewrite part; set (t := turn q2 s); set (h := tanh' q2 s); set (p := front s); rewrite <- root_square; field.
Qed.

Lemma front_falls a b : 0 <= a -> a <= b -> front b <= front a.
Proof.
intros a0 ab; unfold front, bend_peak.front; set (e := exp (- (q2 * (a * a)))); set (d := exp (- (q2 * (b * b)))).
assert (e0 : 0 < e) by apply exp_pos; assert (d0 : 0 < d) by apply exp_pos.
assert (sq : q2 * (a * a) <= q2 * (b * b)) by (apply Rmult_le_compat_l; [lra | apply Rmult_le_compat; lra]).
assert (de : d <= e).
  unfold d, e; destruct (Req_dec (q2 * (a * a)) (q2 * (b * b))) as [-> | ne]; [lra | apply Rlt_le, exp_increasing; lra].
assert (e1 : e <= 1).
  assert (0 <= q2 * (a * a)) by (apply Rmult_le_pos; [lra | apply Rmult_le_pos; lra]).
  unfold e; rewrite <- exp_0; destruct (Req_dec (q2 * (a * a)) 0) as [-> | ne]; [rewrite Ropp_0; lra | apply Rlt_le, exp_increasing; lra].
assert (both : d / ((1 + d) * (1 + d)) <= e / ((1 + e) * (1 + e))).
  apply Rmult_le_reg_r with ((1 + d) * (1 + d) * ((1 + e) * (1 + e))); [repeat apply Rmult_lt_0_compat; lra |].
  replace (d / ((1 + d) * (1 + d)) * ((1 + d) * (1 + d) * ((1 + e) * (1 + e)))) with (d * ((1 + e) * (1 + e))) by (field; lra).
  replace (e / ((1 + e) * (1 + e)) * ((1 + d) * (1 + d) * ((1 + e) * (1 + e)))) with (e * ((1 + d) * (1 + d))) by (field; lra).
  assert (e * d <= 1 * 1) by (apply Rmult_le_compat; lra); assert (0 <= (e - d) * (1 - e * d)) by (apply Rmult_le_pos; lra); lra.
replace (2 * q1 * q2 * d / ((1 + d) * (1 + d))) with (2 * q1 * q2 * (d / ((1 + d) * (1 + d)))) by (unfold Rdiv; ring).
replace (2 * q1 * q2 * e / ((1 + e) * (1 + e))) with (2 * q1 * q2 * (e / ((1 + e) * (1 + e)))) by (unfold Rdiv; ring).
apply Rmult_le_compat_l; [apply Rmult_le_pos; lra | exact both].
Qed.

(* Between x = 1 and 1.65 it falls to a seventh at most. *)
Lemma front_kept a b : 1 <= r * a -> r * b <= 1.65 -> 0 <= b -> front a <= 7 * front b.
Proof.
intros a1 b1 b0; unfold front, bend_peak.front; rewrite <- !square_is.
set (e := exp (- (r * a * (r * a)))); set (d := exp (- (r * b * (r * b)))); assert (r0 := root_pos).
assert (e0 : 0 < e) by apply exp_pos; assert (d0 : 0 < d) by apply exp_pos.
assert (e1 : e <= 0.37).
  assert (1 * 1 <= r * a * (r * a)) by (apply Rmult_le_compat; lra).
  apply Rle_trans with (exp (- (1))); [| interval with (i_prec 60)].
  unfold e; destruct (Req_dec (r * a * (r * a)) 1) as [-> | ne]; [lra | apply Rlt_le, exp_increasing; lra].
assert (rb : 0 <= r * b) by (apply Rmult_le_pos; lra).
assert (d1 : 0.065 <= d).
  apply Rle_trans with (exp (- (1.65 * 1.65))); [clear; interval with (i_prec 60) |].
  assert (r * b * (r * b) <= 1.65 * 1.65) by (apply Rmult_le_compat; lra).
  unfold d; destruct (Req_dec (r * b * (r * b)) (1.65 * 1.65)) as [-> | ne]; [lra | apply Rlt_le, exp_increasing; lra].
assert (d2 : d <= 1).
  unfold d; rewrite <- exp_0; assert (0 <= r * b * (r * b)) by (apply Rmult_le_pos; lra).
  destruct (Req_dec (r * b * (r * b)) 0) as [-> | ne]; [rewrite Ropp_0; lra | apply Rlt_le, exp_increasing; lra].
assert (both : e / ((1 + e) * (1 + e)) <= 7 * (d / ((1 + d) * (1 + d)))).
  apply Rmult_le_reg_r with ((1 + d) * (1 + d) * ((1 + e) * (1 + e))); [repeat apply Rmult_lt_0_compat; lra |].
  replace (7 * (d / ((1 + d) * (1 + d))) * ((1 + d) * (1 + d) * ((1 + e) * (1 + e)))) with (7 * d * ((1 + e) * (1 + e))) by (field; lra).
  replace (e / ((1 + e) * (1 + e)) * ((1 + d) * (1 + d) * ((1 + e) * (1 + e)))) with (e * ((1 + d) * (1 + d))) by (field; lra).
  assert (e * d <= 0.37 * d) by (apply Rmult_le_compat_r; lra); assert (0 <= e * d) by (apply Rmult_le_pos; lra).
  assert (e * d * d <= e * d * 1) by (apply Rmult_le_compat_l; lra); assert (0 <= d * (e * e)) by (repeat apply Rmult_le_pos; lra); lra.
replace (2 * q1 * q2 * d / ((1 + d) * (1 + d))) with (2 * q1 * q2 * (d / ((1 + d) * (1 + d)))) by (unfold Rdiv; ring).
replace (2 * q1 * q2 * e / ((1 + e) * (1 + e))) with (2 * q1 * q2 * (e / ((1 + e) * (1 + e)))) by (unfold Rdiv; ring).
assert (0 <= 2 * q1 * q2) by (apply Rmult_le_pos; lra).
assert (2 * q1 * q2 * (e / ((1 + e) * (1 + e))) <= 2 * q1 * q2 * (7 * (d / ((1 + d) * (1 + d))))) by (apply Rmult_le_compat_l; assumption); lra.
Qed.

Variable star : R.
Hypothesis star_nonneg : 0 <= star.
Hypothesis turns : turn q2 star = 1.

Lemma K_front s : star <= s <= R2 -> 2 * front s * s <= K s.
Proof.
intros [ss sR]; assert (T := @T_after q2 q2_pos star star_nonneg turns s ss); cbv beta in T.
assert (fr := front_nonneg q1_nonneg q2_pos s); fold (front s) in fr.
assert (is : f q1 q2 s = front s * s).
  unfold f, front, bend_peak.front; field; assert (e0 := exp_pos (- (q2 * (s * s)))); lra.
unfold K; rewrite (K_after R2 q1_nonneg q2_pos T); unfold K2; rewrite is.
assert (0 <= (R2 - s) * g q1 q2 s) by (apply Rmult_le_pos; [lra | unfold g; fold (front s); apply Rmult_le_pos; lra]); lra.
Qed.

Lemma K_apart a b : star <= a -> a < b -> exists c, a < c < b /\ K b - K a = 2 * front c * gap_at c * (b - a).
Proof.
intros sa ab; assert (Ta := @T_after q2 q2_pos star star_nonneg turns a sa); cbv beta in Ta.
assert (Tb := @T_after q2 q2_pos star star_nonneg turns b ltac:(lra)); cbv beta in Tb.
destruct (mean q1 q2 R2 ab) as [c [cin is]]; exists c; split; [exact cin |].
unfold K; rewrite (K_after R2 q1_nonneg q2_pos Ta), (K_after R2 q1_nonneg q2_pos Tb), is, slope_gap; reflexivity.
Qed.

Theorem step_up a b M : star <= a -> a <= b -> b <= R2 -> 1 <= r * a -> 0 <= M -> (forall c, a < c < b -> gap_at c <= M) ->
  K b <= (1 + M * (r * (b - a))) * K a.
Proof.
intros sa [ab | <-] bR a1 M0 all; [| replace (r * (a - a)) with 0 by ring; lra].
destruct (K_apart a b sa ab) as [c [cin is]]; assert (H := all c cin); assert (F := front_falls a c ltac:(lra) ltac:(lra)).
assert (fc := front_nonneg q1_nonneg q2_pos c); fold (front c) in fc; assert (L := K_front a ltac:(lra)); assert (r0 := root_pos).
assert (p1 : front c * gap_at c <= front a * M).
  apply Rle_trans with (front c * M); [apply Rmult_le_compat_l | apply Rmult_le_compat_r]; lra.
assert (p2 : front c * gap_at c * (b - a) <= front a * M * (b - a)) by (apply Rmult_le_compat_r; lra).
assert (fa : 0 <= front a * (M * (b - a))) by (apply Rmult_le_pos; [lra | apply Rmult_le_pos; lra]).
assert (p3 : front a * (M * (b - a)) * 1 <= front a * (M * (b - a)) * (r * a)) by (apply Rmult_le_compat_l; lra).
assert (p4 : M * (r * (b - a)) * (2 * front a * a) <= M * (r * (b - a)) * K a).
  apply Rmult_le_compat_l; [repeat apply Rmult_le_pos; lra | exact L].
lra.
Qed.

Theorem step_down a b M : star <= a -> a <= b -> b <= R2 -> 1 <= r * a -> r * b <= 1.65 -> 0 <= M -> (forall c, a < c < b -> - M <= gap_at c) ->
  K a <= (1 + 7 * M * (r * (b - a))) * K b.
Proof.
intros sa [ab | <-] bR a1 b1 M0 all; [| replace (r * (a - a)) with 0 by ring; lra].
destruct (K_apart a b sa ab) as [c [cin is]]; assert (H := all c cin); assert (F := front_falls a c ltac:(lra) ltac:(lra)).
assert (F7 := front_kept a b a1 b1 ltac:(lra)).
assert (fc := front_nonneg q1_nonneg q2_pos c); fold (front c) in fc; assert (L := K_front b ltac:(lra)); assert (r0 := root_pos).
assert (p1 : front c * - gap_at c <= 7 * front b * M).
  apply Rle_trans with (front c * M); [apply Rmult_le_compat_l | apply Rmult_le_compat_r]; lra.
assert (p2 : front c * - gap_at c * (b - a) <= 7 * front b * M * (b - a)) by (apply Rmult_le_compat_r; lra).
assert (fb : 0 <= front b * (M * (b - a))) by (apply Rmult_le_pos; [lra | apply Rmult_le_pos; lra]).
assert (rb : 1 <= r * b) by (apply Rle_trans with (1 := a1); apply Rmult_le_compat_l; lra).
assert (p3 : front b * (M * (b - a)) * 1 <= front b * (M * (b - a)) * (r * b)) by (apply Rmult_le_compat_l; lra).
assert (p4 : M * (r * (b - a)) * (2 * front b * b) <= M * (r * (b - a)) * K b).
  apply Rmult_le_compat_l; [repeat apply Rmult_le_pos; lra | exact L].
lra.
Qed.
End Steps.
