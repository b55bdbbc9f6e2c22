(* How sharply a link weight bends (docs/theory/weights.md, eq:curvature-bound).

   In words. With f the slope of weights.v and K(s) = 2 f(s) + 4 (R^2 - s) max(0, - f'(s)), let K <= kappa for all s >= 0 that the
   pair takes on its way from offset r to r + w. Then a(r + w) >= a(r) + grad a . w - kappa/2 |w|^2: what (far') assumes in
   budget.v. The way may lead out of range.

   That K has a single peak, so that K at the closest point to it is the largest, is in bend_peak.v. *)

From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import intervals vectors weights.
Import ExactIntervals.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Lemma rises (G G1 : R -> R) T : 0 <= T -> (forall t, 0 <= t <= T -> is_derive G t (G1 t)) ->
  (forall t, 0 <= t <= T -> 0 <= G1 t) -> G 0 <= G T.
Proof.
move=> T0 der pos; have [c [cin E]] : exists c, Rmin 0 T <= c <= Rmax 0 T /\ G T - G 0 = G1 c * (T - 0).
  apply: MVT_gen => c; rewrite Rmin_left ?Rmax_right // => cin; first by apply: der; lra.
  by apply: derivable_continuous_pt; exists (G1 c); apply/is_derive_Reals/der.
move: cin; rewrite Rmin_left ?Rmax_right // => cin; have := pos c cin; nra.
Qed.

Lemma arithmetic m z D g h c kappa : 0 <= m -> - g <= m -> 0 <= z -> z <= D * c -> 0 <= c ->
  2 * h + 4 * D * m <= kappa -> - (kappa * c) <= g * (4 * z) - 2 * c * h.
Proof.
move=> m0 m1 z0 cs c0 le.
have e1 : - (m * z) <= g * z by nra.
have e2 : m * z <= m * (D * c) by exact: Rmult_le_compat_l.
have e3 := Rmult_le_compat_r c _ _ c0 le; lra.
Qed.

(* The derivative of f. *)
Definition f' (q1 q2 s : R) := 2 * q1 * q2 * exp (- (q2 * (s * s))) /
  ((1 + exp (- (q2 * (s * s)))) * (1 + exp (- (q2 * (s * s))))) *
  (1 - 2 * q2 * (s * s) * (1 - exp (- (q2 * (s * s)))) / (1 + exp (- (q2 * (s * s))))).

Lemma f_derive q1 q2 s : is_derive (f q1 q2) s (f' q1 q2 s).
Proof.
have e0 := exp_pos (- (q2 * (s * s))); rewrite /f /f'; auto_derive.
  by apply: Rgt_not_eq; apply: Rmult_lt_0_compat; lra.
by field; lra.
Qed.

Section Curvature.
Variables q1 q2 R2 : R.
Hypothesis q1_nonneg : 0 <= q1.
Hypothesis q2_pos : 0 < q2.
Definition K (s : R) := 2 * f q1 q2 s + 4 * (R2 - s) * Rmax 0 (- f' q1 q2 s).

Variables (d : nat) (r w : vec d).
Let a := sq r.
Let b := dot r w.
Let c := sq w.
(* s on the way, after the part t of w *)
Let s t := R2 - (a + 2 * t * b + t * t * c).
Let psi t := rise q1 q2 (s t).
Let psi1 t := f q1 q2 (s t) * (-2 * (b + t * c)).
Let psi2 t := f' q1 q2 (s t) * (4 * ((b + t * c) * (b + t * c))) - 2 * c * f q1 q2 (s t).

Lemma s_derive t : derivable_pt_lim s t (-2 * (b + t * c)).
Proof. by apply/is_derive_Reals; rewrite /s; move: a b c => a' b' c'; auto_derive => //; ring. Qed.

Lemma psi_derive t : is_derive psi t (psi1 t).
Proof.
apply/is_derive_Reals; apply: (derivable_pt_lim_comp s (rise q1 q2)); first exact: s_derive.
by apply/is_derive_Reals; exact: rise_derive.
Qed.

Lemma psi1_derive t : is_derive psi1 t (psi2 t).
Proof.
apply/is_derive_Reals.
have lin : derivable_pt_lim (fun t => -2 * (b + t * c)) t (-2 * c).
  by apply/is_derive_Reals; move: b c => b' c'; auto_derive => //; ring.
have outer : derivable_pt_lim (fun t => f q1 q2 (s t)) t (f' q1 q2 (s t) * (-2 * (b + t * c))).
  apply: (derivable_pt_lim_comp s (f q1 q2)); first exact: s_derive.
  by apply/is_derive_Reals; exact: f_derive.
have := derivable_pt_lim_mult _ _ _ _ _ outer lin.
have -> : f' q1 q2 (s t) * (-2 * (b + t * c)) * (-2 * (b + t * c)) + f q1 q2 (s t) * (-2 * c) = psi2 t.
  by rewrite /psi2; ring.
by [].
Qed.

Variable kappa : R.
Hypothesis kappa0 : 0 <= kappa.
Hypothesis bound : forall t, 0 <= t <= 1 -> 0 <= s t -> K (s t) <= kappa.

Lemma psi2_low t : 0 <= t <= 1 -> 0 <= s t -> - (kappa * c) <= psi2 t.
Proof.
move=> t01 s0; have := bound t01 s0; rewrite /K /psi2.
have c0 : 0 <= c by exact: sq_nonneg.
have cs : (b + t * c) * (b + t * c) <= (R2 - s t) * c.
  have := cauchy_schwarz (plus r (times t w)) w; rewrite dot_plus dot_times sq_plus dot_times_r sq_times /s /a /b /c /sq.
  move=> h; apply: Rle_trans h _; lra.
have square z : 0 <= z * z by nra.
have sq0 := square (b + t * c).
by move=> le; exact: (arithmetic (Rmax_l _ _) (Rmax_r _ _) sq0 cs c0 le).
Qed.

Lemma stays_in T t : 0 <= t <= T -> 0 <= s 0 -> 0 <= s T -> 0 <= s t.
Proof.
move=> tT s0 sT; have c0 : 0 <= c by exact: sq_nonneg.
case: (Req_dec T 0) => [T0 | Tn]; first by have -> : t = 0 by lra.
have key : 0 <= T * s t - ((T - t) * s 0 + t * s T).
  have -> : T * s t - ((T - t) * s 0 + t * s T) = c * (t * T * (T - t)) by rewrite /s; ring.
  by apply: Rmult_le_pos => //; apply: Rmult_le_pos; nra.
have : 0 <= (T - t) * s 0 + t * s T by nra.
move=> h; apply: (Rmult_le_reg_l T); [lra | rewrite Rmult_0_r; lra].
Qed.

Lemma slope_low T : 0 <= T <= 1 -> 0 <= s 0 -> 0 <= s T -> psi1 0 - kappa * c * T <= psi1 T.
Proof.
move=> T01 s0 sT; have := @rises (fun t => psi1 t + kappa * c * t) (fun t => psi2 t + kappa * c) T.
have h1 : 0 <= T by lra.
move=> /(_ h1) h; have {}h := h _ _; have : psi1 0 + kappa * c * 0 <= psi1 T + kappa * c * T; last lra.
apply: h => t tT.
  apply: is_derive_plus; first exact: psi1_derive.
  by auto_derive => //; ring.
have := psi2_low (t := t); have := stays_in tT s0 sT => st /(_ ltac:(lra) st); lra.
Qed.

Lemma weight_low T : 0 <= T <= 1 -> 0 <= s 0 -> 0 <= s T ->
  psi 0 + psi1 0 * T - kappa / 2 * c * (T * T) <= psi T.
Proof.
move=> T01 s0 sT.
have := @rises (fun t => psi t + (- psi1 0 * t + kappa / 2 * c * (t * t)))
  (fun t => psi1 t + (- psi1 0 + kappa * c * t)) T.
have h1 : 0 <= T by lra.
move=> /(_ h1) h; have {}h := h _ _.
have : psi 0 + (- psi1 0 * 0 + kappa / 2 * c * (0 * 0)) <= psi T + (- psi1 0 * T + kappa / 2 * c * (T * T)); last lra.
apply: h => t tT.
  apply: is_derive_plus; first exact: psi_derive.
  by auto_derive => //; field.
have st := stays_in tT s0 sT; have := @slope_low t ltac:(lra) s0 st; lra.
Qed.

(* The gradient of the weight with respect to the first robot: -2 f (x_i - x_j). *)
Definition gradient (r : vec d) : vec d := times (-2 * f q1 q2 (Rmax (R2 - sq r) 0)) r.

(* eq:curvature-bound *)
Theorem curvature_bound : sq r <= R2 ->
  weight q1 q2 R2 (sq (plus r w)) >= weight q1 q2 R2 (sq r) + dot (gradient r) w - kappa / 2 * sq w.
Proof.
move=> inside; have s0 : 0 <= s 0 by rewrite /s /a; lra.
have E0 : s 0 = R2 - sq r by rewrite /s /a; ring.
have E1 : s 1 = R2 - sq (plus r w) by rewrite /s /a /b /c sq_plus; ring.
have Eg : dot (gradient r) w = psi1 0.
  by rewrite /gradient dot_times /psi1 E0 Rmax_left; [rewrite /b; ring | lra].
have W0 : weight q1 q2 R2 (sq r) = psi 0 by rewrite /weight /psi E0 Rmax_left //; lra.
rewrite Eg W0 -/c; case: (Rle_lt_dec 0 (s 1)) => s1.
  have W1 : weight q1 q2 R2 (sq (plus r w)) = psi 1 by rewrite /weight /psi E1 Rmax_left //; lra.
  have := @weight_low 1 ltac:(lra) s0 s1; rewrite W1; lra.
have -> : weight q1 q2 R2 (sq (plus r w)) = 0 by apply: weight_out_of_range; lra.
have [t [[t0 t1] st]] : {t | 0 <= t <= 1 /\ s t = 0}.
  by apply: IVT_cor; [rewrite /s; reg | lra | nra].
have st0 : 0 <= s t by lra.
have low := @weight_low t ltac:(lra) s0 st0; have slope := @slope_low t ltac:(lra) s0 st0.
have z1 : psi1 t = 0 by rewrite /psi1 st /f Rmult_0_r; field; have := exp_pos (- (q2 * (0 * 0))); lra.
have z0 : psi t = 0.
  by rewrite /psi st /rise !Rmult_0_r Ropp_0 exp_0; field.
have c0 : 0 <= c by exact: sq_nonneg.
have kc : 0 <= kappa * c by exact: Rmult_le_pos.
rewrite z1 in slope; rewrite z0 in low.
have : psi1 0 * (1 - t) <= kappa * c * t * (1 - t) by apply: Rmult_le_compat_r; lra.
have : 0 <= kappa * c * ((1 - t) * (1 - t)) by apply: Rmult_le_pos => //; nra.
nra.
Qed.
End Curvature.

(* For every q1, q2 and R at once: a bound of K that needs no search. The code takes a smaller one, for each pair. *)
Definition bend_shape u := 2 * exp (- (u * u)) / ((1 + exp (- (u * u))) * (1 + exp (- (u * u)))) *
  (2 * (u * u) * (1 - exp (- (u * u))) / (1 + exp (- (u * u))) - 1).

Lemma bend_near u : 0 <= u <= 4 -> bend_shape u <= 0.459.
Proof. by move=> [u0 u4]; rewrite /bend_shape; interval with (i_bisect u, i_taylor u, i_depth 40, i_prec 60). Qed.

Lemma bend_far u : 4 <= u -> bend_shape u <= 0.459.
Proof.
move=> u4; rewrite /bend_shape; have e0 := exp_pos (- (u * u)).
have big : 1 + u * u / 4 < exp (u * u / 4) by apply: exp_ineq1; nra.
have inv : exp (- (u * u)) * (exp (u * u / 4) * exp (u * u / 4) * (exp (u * u / 4) * exp (u * u / 4))) = 1.
  by rewrite -!exp_plus -exp_0; congr exp; field.
move: (exp (- (u * u))) (exp (u * u / 4)) e0 big inv => e H e0 big inv.
have H5 : 5 <= H by nra.
have H2 : 25 <= H * H by nra.
have H3 : 125 <= H * H * H by nra.
have eH : e * H * 125 <= 1.
  have eH0 : 0 <= e * H by nra.
  have := Rmult_le_compat_l _ _ _ eH0 H3; nra.
have ue : 4 * (u * u * e) <= 0.128 by nra.
have e1 : e <= 1 by nra.
have -> : 2 * e / ((1 + e) * (1 + e)) * (2 * (u * u) * (1 - e) / (1 + e) - 1) =
  (4 * (u * u * e) * (1 - e) - 2 * e * (1 + e)) / ((1 + e) * (1 + e) * (1 + e)) by field; lra.
have bot : 1 <= (1 + e) * (1 + e) * (1 + e) by nra.
apply: (Rmult_le_reg_r ((1 + e) * (1 + e) * (1 + e))); first lra.
have -> : (4 * (u * u * e) * (1 - e) - 2 * e * (1 + e)) / ((1 + e) * (1 + e) * (1 + e)) *
  ((1 + e) * (1 + e) * (1 + e)) = 4 * (u * u * e) * (1 - e) - 2 * e * (1 + e) by field; lra.
have z0 : 0 <= u * u * e by nra.
nra.
Qed.

Theorem K_bound q1 q2 R2 s : 0 <= q1 -> 0 < q2 -> 0 <= s <= R2 ->
  K q1 q2 R2 s <= 0.7872 * q1 * sqrt q2 + 1.836 * R2 * (q1 * q2).
Proof.
move=> q1_0 q2_0 [s0 sR]; have qq : 0 <= q1 * q2 by nra.
have slope := slope_bound q1_0 q2_0 s0.
have r0 := sqrt_pos q2; have rr := sqrt_sqrt q2 (Rlt_le _ _ q2_0).
have E : q2 * (s * s) = (sqrt q2 * s) * (sqrt q2 * s) by rewrite -{1}rr; ring.
have bend : - f' q1 q2 s = q1 * q2 * bend_shape (sqrt q2 * s).
  have e0 := exp_pos (- ((sqrt q2 * s) * (sqrt q2 * s))).
  have two : 2 * q2 * (s * s) = 2 * (q2 * (s * s)) by ring.
  by rewrite /f' /bend_shape two E; field; lra.
have le : bend_shape (sqrt q2 * s) <= 0.459.
  have u0 := Rmult_le_pos _ _ r0 s0.
  by case: (Rle_lt_dec (sqrt q2 * s) 4) => h; [exact: bend_near | apply: bend_far; lra].
have top : Rmax 0 (- f' q1 q2 s) <= 0.459 * (q1 * q2).
  by apply: Rmax_lub; [nra | rewrite bend; nra].
have : (R2 - s) * Rmax 0 (- f' q1 q2 s) <= R2 * (0.459 * (q1 * q2)).
  apply: Rmult_le_compat; [lra | exact: Rmax_l | lra | exact: top].
rewrite /K; lra.
Qed.
