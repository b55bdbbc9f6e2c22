(* The link weight: how fast it falls, and that a sum of weights counts neighbours (docs/theory/weights.md: eq:slope-bound,
   lem:degree).

   In words. With s = R^2 - D and e = exp(- q2 s^2), a = q1/(1 + e) - q1/2 where s >= 0, else 0. Its slope is
   |da/dD| = f(s) = 2 q1 q2 s e/(1 + e)^2.

   `weight_falls`: if f <= L between the two values of s that a pair can have in a tick, the weight falls by at most L per unit of
   D: what (far) assumes in budget.v. `slope_bound`: f <= 0.3936 q1 sqrt(q2) for all q1 >= 0, q2 > 0, s >= 0 (the theory page says
   0.3935..., rounded up here). With u = sqrt(q2) s, f = 2 q1 sqrt(q2) shape(u), so one bound on `shape`, by
   interval arithmetic on [0, 4], serves every q1 and q2.
   `degree_counts` is lem:degree: h_k >= 0 means at least `need` neighbours.

   That f has a single peak is in peak.v, the curvature bound in curvature.v. *)

From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import intervals vectors.
Import ExactIntervals.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Definition shape (u : R) := u * exp (- (u * u)) / ((1 + exp (- (u * u))) * (1 + exp (- (u * u)))).

Lemma shape_near u : 0 <= u <= 4 -> shape u <= 0.1968.
Proof. by move=> [u0 u4]; rewrite /shape; interval with (i_bisect u, i_taylor u, i_depth 40, i_prec 60). Qed.

Lemma shape_far u : 4 <= u -> shape u <= 0.1968.
Proof.
move=> u4; rewrite /shape; have e0 := exp_pos (- (u * u)).
have big : 1 + u * u / 2 < exp (u * u / 2) by apply: exp_ineq1; nra.
have inv : exp (- (u * u)) * exp (u * u / 2) * exp (u * u / 2) = 1.
  by rewrite -!exp_plus -exp_0; congr exp; field.
move: (exp (- (u * u))) (exp (u * u / 2)) e0 big inv => e E e0 big inv.
have uE : u <= E by nra.
have E9 : 9 <= E by nra.
have ue : u * e * E <= 1 by have := Rmult_le_compat_r (e * E) u E ltac:(nra) uE; lra.
have ue0 : 0 <= u * e by nra.
have ue9 : u * e * 9 <= 1 by nra.
apply: (Rmult_le_reg_r ((1 + e) * (1 + e))); first nra.
have -> : u * e / ((1 + e) * (1 + e)) * ((1 + e) * (1 + e)) = u * e by field; lra.
nra.
Qed.

Lemma shape_bound u : 0 <= u -> shape u <= 0.1968.
Proof. by move=> u0; case: (Rle_lt_dec u 4) => h; [exact: shape_near | apply: shape_far; lra]. Qed.

Section Weight.
Variables q1 q2 : R.
Hypothesis q1_nonneg : 0 <= q1.
Hypothesis q2_pos : 0 < q2.

Definition rise (s : R) := q1 / (1 + exp (- (q2 * (s * s)))) - q1 / 2.
Definition f (s : R) := 2 * q1 * q2 * s * exp (- (q2 * (s * s))) /
  ((1 + exp (- (q2 * (s * s)))) * (1 + exp (- (q2 * (s * s))))).
(* The weight of a link of squared length D. *)
Definition weight (R2 D : R) := rise (Rmax (R2 - D) 0).

Lemma rise_derive s : is_derive rise s (f s).
Proof.
have e0 := exp_pos (- (q2 * (s * s))).
by rewrite /rise /f; auto_derive; [lra | field; lra].
Qed.

(* eq:slope-bound *)
Theorem slope_bound s : 0 <= s -> f s <= 0.3936 * q1 * sqrt q2.
Proof.
move=> s0; have r0 := sqrt_pos q2; have rr := sqrt_sqrt q2 (Rlt_le _ _ q2_pos).
have E : q2 * (s * s) = (sqrt q2 * s) * (sqrt q2 * s) by rewrite -{1}rr; ring.
have -> : f s = 2 * q1 * sqrt q2 * shape (sqrt q2 * s).
  have e0 := exp_pos (- (q2 * (s * s))).
  by rewrite /f /shape -E -{1}rr; field; lra.
have := shape_bound (Rmult_le_pos _ _ r0 s0); have := Rmult_le_pos _ _ q1_nonneg r0; nra.
Qed.

Lemma f_nonneg s : 0 <= s -> 0 <= f s.
Proof.
move=> s0; have e0 := exp_pos (- (q2 * (s * s))); apply: Rmult_le_pos.
  apply: Rmult_le_pos; [apply: Rmult_le_pos => //; nra | lra].
by apply/Rlt_le/Rinv_0_lt_compat; nra.
Qed.

Lemma rise_between s0 s1 L : 0 <= s0 <= s1 -> (forall s, s0 <= s <= s1 -> f s <= L) ->
  0 <= rise s1 - rise s0 <= L * (s1 - s0).
Proof.
move=> [h0 h1] bound.
have [c [cin ->]] : exists c, Rmin s0 s1 <= c <= Rmax s0 s1 /\ rise s1 - rise s0 = f c * (s1 - s0).
  apply: MVT_gen => c cin; first exact: rise_derive.
  by apply: derivable_continuous_pt; exists (f c); apply/is_derive_Reals/rise_derive.
have {}cin : s0 <= c <= s1 by move: cin; rewrite Rmin_left ?Rmax_right //; lra.
have := bound c cin; have : 0 <= f c by apply: f_nonneg; lra.
nra.
Qed.

Lemma weight_nonneg R2 D : 0 <= weight R2 D.
Proof.
have m0 := Rmax_r (R2 - D) 0.
have L s : 0 <= s <= Rmax (R2 - D) 0 -> f s <= 0.3936 * q1 * sqrt q2 by move=> [s0 _]; exact: slope_bound.
have z : rise 0 = 0 by rewrite /rise !Rmult_0_r Ropp_0 exp_0; field.
by have := rise_between (conj (Rle_refl 0) m0) L; rewrite z /weight; lra.
Qed.

Lemma weight_out_of_range R2 D : R2 <= D -> weight R2 D = 0.
Proof. by move=> h; rewrite /weight Rmax_right; [rewrite /rise !Rmult_0_r Ropp_0 exp_0; field | lra]. Qed.

(* 1 + eps/2 with q1 = 2 + eps *)
Lemma weight_below R2 D : weight R2 D <= q1 / 2.
Proof.
rewrite /weight /rise; set e := exp _; have e0 : 0 < e by exact: exp_pos.
have : q1 / (1 + e) <= q1; last by lra.
apply: (Rmult_le_reg_r (1 + e)); first lra.
by have -> : q1 / (1 + e) * (1 + e) = q1 by [field; lra]; nra.
Qed.

(* What (far) needs: a weight falls by at most L per unit of squared distance. *)
Theorem weight_falls R2 D D' L : 0 <= L ->
  (forall s, Rmax (R2 - D') 0 <= s <= Rmax (R2 - D) 0 -> f s <= L) ->
  weight R2 D' >= weight R2 D - L * Rmax (D' - D) 0.
Proof.
move=> L0 bound; have m0 := Rmax_r (D' - D) 0.
case: (Rle_lt_dec D' D) => h.
  have le : 0 <= Rmax (R2 - D) 0 <= Rmax (R2 - D') 0.
    by split; [exact: Rmax_r | apply: Rle_max_compat_r; lra].
  have := rise_between le (fun s h => slope_bound (Rle_trans _ _ _ (proj1 le) (proj1 h))).
  rewrite /weight; have : 0 <= L * Rmax (D' - D) 0 by exact: Rmult_le_pos.
  lra.
have le : 0 <= Rmax (R2 - D') 0 <= Rmax (R2 - D) 0.
  by split; [exact: Rmax_r | apply: Rle_max_compat_r; lra].
have := rise_between le bound; rewrite /weight [Rmax (D' - D) 0]Rmax_left; last lra.
have : Rmax (R2 - D) 0 - Rmax (R2 - D') 0 <= D' - D.
  by rewrite /Rmax; case: (Rle_dec _ _) => ?; case: (Rle_dec _ _) => ?; lra.
nra.
Qed.
End Weight.

(* lem:degree *)
Theorem degree_counts (V : finType) (N : {set V}) (a : V -> R) (eps : R) (need : nat) :
  (forall j, j \in N -> a j <= 1 + eps / 2) -> 0 <= eps -> (INR need - 1) * eps < 2 ->
  0 <= \big[Rplus/0]_(j in N) a j - INR need -> (need <= #|N|)%N.
Proof.
move=> small eps0 le h; rewrite leqNgt; apply/negP => few.
have : \big[Rplus/0]_(j in N) a j <= INR #|N| * (1 + eps / 2) by rewrite -sum_const; exact: sum_le.
have : INR #|N| + 1 <= INR need by rewrite -S_INR; apply: le_INR; apply/leP.
have := pos_INR #|N|; nra.
Qed.
