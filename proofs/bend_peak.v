(* Where a link weight bends most sharply (docs/theory/weights.md, eq:curvature-bound).

   In words. K rises up to one point of [0, R^2] and falls from there (`single_peak`). So on an interval K is largest at the point closest to
   that peak: what the code takes for kappa (`largest_bend`). The code finds the peak by halving, with a test of one s that is `rises` here:
   where the test says yes, K rises up to this s, and where it says no, K falls from there on (`test_yes`, `test_no`). So after any number of
   halvings the peak lies between the two ends (`peak_between`). `peak_exists`: 4 z tanh z = 1 has a solution, which is where K begins to
   have a second term, and z = 0.5218134477957685, which the code has, is within 1e-15 of it (`steepest`).

   The test is in real numbers here, and so is K. *)

From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import intervals vectors weights curvature peak.
Import ExactIntervals.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Section Bend.
Variables q1 q2 R2 : R.
Hypothesis q1_nonneg : 0 <= q1.
Hypothesis q2_pos : 0 < q2.
Let e s := exp (- (q2 * (s * s))).
Let T s := turn q2 s.
Let K := K q1 q2 R2.

Lemma e_pos s : 0 < e s. Proof. exact: exp_pos. Qed.
Lemma e_below s : 0 < s -> e s < 1.
Proof.
move=> s0; have ss := Rmult_lt_0_compat _ _ s0 s0; have p := Rmult_lt_0_compat _ _ q2_pos ss.
by rewrite /e -exp_0; apply: exp_increasing; lra.
Qed.

Lemma e_derive s : is_derive e s (- (2 * q2 * s * e s)).
Proof. by unfold e; auto_derive; [done | ring]. Qed.

(* tanh z *)
Definition tanh' s := (1 - e s) / (1 + e s).

Lemma tanh_range s : 0 <= s -> 0 <= tanh' s <= 1.
Proof.
move=> s0; have e0 := e_pos s.
have e1 : e s <= 1.
  have le : - (q2 * (s * s)) <= 0 by nra.
  by rewrite /e -exp_0; case: le => [lt | ->]; [apply/Rlt_le/exp_increasing | apply: Rle_refl].
have i0 : 0 < / (1 + e s) by apply: Rinv_0_lt_compat; lra.
rewrite /tanh'; split; first by apply: Rmult_le_pos; lra.
by apply: (Rmult_le_reg_r (1 + e s)); [lra | rewrite /Rdiv Rmult_assoc Rinv_l; lra].
Qed.

Lemma tanh_mono s t : 0 <= s <= t -> tanh' s <= tanh' t.
Proof.
move=> [s0 st]; have es := e_pos s; have et := e_pos t.
have ee : e t <= e s.
  case: (Req_dec (s * s) (t * t)) => [E | ne]; first by rewrite /e E; lra.
  by apply/Rlt_le/exp_increasing; nra.
have part c : 0 < c -> (1 - c) / (1 + c) = 2 / (1 + c) - 1 by move=> c0; field; lra.
have : 2 / (1 + e s) <= 2 / (1 + e t) by apply: Rmult_le_compat_l; [lra | apply: Rinv_le_contravar; lra].
by rewrite /tanh' !part //; lra.
Qed.

Lemma T_tanh s : T s = 2 * q2 * (s * s) * tanh' s.
Proof. by rewrite /T /turn /tanh' /e /Rdiv; ring. Qed.

(* 2 sinh(q2 s^2)/s never falls. *)
Definition spread s := (/ e s - e s) / s.

Lemma spread_mono s t : 0 < s -> s <= t -> spread s <= spread t.
Proof.
move=> s0 st.
pose D u := (2 * q2 * (u * u) * (/ e u + e u) - (/ e u - e u)) / (u * u).
have der u : 0 < u -> is_derive spread u (D u).
  move=> u0; have e0 := e_pos u; rewrite /spread /D; unfold e in *; auto_derive; first by repeat split; lra.
  by field; split; lra.
have pos u : 0 < u -> 0 <= D u.
  move=> u0; have e0 := e_pos u; rewrite /D.
  have low : 1 - 2 * (q2 * (u * u)) <= e u * e u.
    rewrite /e -exp_plus; have := exp_ineq1_le (- (q2 * (u * u)) + - (q2 * (u * u))); lra.
  have i0 : 0 < / e u by exact: Rinv_0_lt_compat.
  have ie : / e u * e u = 1 by apply: Rinv_l; lra.
  apply: Rmult_le_pos; last by apply/Rlt_le/Rinv_0_lt_compat; nra.
  have y0 : 0 <= q2 * (u * u) by apply: Rmult_le_pos; nra.
  have -> : 2 * q2 * (u * u) = 2 * (q2 * (u * u)) by ring.
  move: (e u) (/ e u) (q2 * (u * u)) i0 ie e0 low y0 => c i y i0 ie c0 low y0.
  have := Rmult_le_compat_l i _ _ (Rlt_le _ _ i0) low; have -> : i * (c * c) = i * c * c by ring.
  rewrite ie => le; have yc : 0 <= y * c by apply: Rmult_le_pos; lra.
  by lra.
case: st => [lt | ->]; last lra.
have [c [E cin]] : exists c, spread t - spread s = D c * (t - s) /\ s < c < t.
  by apply: MVT_cor2 => // c cin; apply/is_derive_Reals/der; lra.
have : 0 <= D c * (t - s) by apply: Rmult_le_pos; [apply: pos; lra | lra].
lra.
Qed.

Lemma spread_pos s : 0 < s -> 0 < spread s.
Proof.
move=> s0; have e0 := e_pos s; have e1 := e_below s0; have i1 : / 1 < / e s by apply: Rinv_lt_contravar; lra.
by rewrite Rinv_1 in i1; apply: Rmult_lt_0_compat; [lra | exact: Rinv_0_lt_compat].
Qed.

(* The slope of T, and of its logarithm. *)
Definition T1 s := 4 * q2 * s * tanh' s + 2 * q2 * (s * s) * (4 * q2 * s * e s / ((1 + e s) * (1 + e s))).
Definition log_slope s := 2 / s + 4 * q2 / spread s.

Lemma T_derive s : is_derive T s (T1 s).
Proof.
have e0 := e_pos s; rewrite /T /turn /T1 /tanh' /e; rewrite /e in e0; auto_derive; first by lra.
by field; lra.
Qed.

Lemma T1_log s : 0 < s -> T1 s = T s * log_slope s.
Proof.
move=> s0; have e0 := e_pos s; have e1 := e_below s0.
rewrite T_tanh /T1 /log_slope /tanh' /spread; field; nra.
Qed.

Lemma log_slope_falls s t : 0 < s -> s <= t -> 0 < log_slope t <= log_slope s.
Proof.
move=> s0 st; have ps := spread_pos s0; have pt : 0 < spread t by apply: spread_pos; lra.
have m := spread_mono s0 st; have it : 0 < / t by apply: Rinv_0_lt_compat; lra.
have jt : 0 < / spread t by exact: Rinv_0_lt_compat.
have i1 : / t <= / s by apply: Rinv_le_contravar; lra.
have i2 : / spread t <= / spread s by apply: Rinv_le_contravar; lra.
by rewrite /log_slope /Rdiv; nra.
Qed.

(* The weight's slope falls: g = - f'. *)
Definition front s := 2 * q1 * q2 * e s / ((1 + e s) * (1 + e s)).
Definition g s := front s * (T s - 1).
Definition g1 s := - (2 * q2 * s * tanh' s) * front s * (T s - 1) + front s * T1 s.

Lemma front_nonneg s : 0 <= front s.
Proof. exact: (peak.front q1_nonneg q2_pos). Qed.

Lemma front_derive s : is_derive front s (- (2 * q2 * s * tanh' s) * front s).
Proof.
have e0 := e_pos s; rewrite /front /tanh' /e; rewrite /e in e0; auto_derive; first by nra.
by field; lra.
Qed.

Lemma g_f s : g s = - f' q1 q2 s.
Proof. by rewrite f'_turn /g /front /T /e; ring. Qed.

Lemma g_derive s : is_derive g s (g1 s).
Proof.
apply/is_derive_Reals.
have -> : g1 s = - (2 * q2 * s * tanh' s) * front s * (T s - 1) + front s * (T1 s - 0) by rewrite /g1; ring.
apply: (derivable_pt_lim_mult front (fun s => T s - 1)); first by apply/is_derive_Reals; exact: front_derive.
apply: (derivable_pt_lim_minus T (fun _ => 1)); first by apply/is_derive_Reals; exact: T_derive.
exact: derivable_pt_lim_const.
Qed.

Definition K2 s := 2 * f q1 q2 s + 4 * (R2 - s) * g s.
Definition K2' s := - 6 * g s + 4 * (R2 - s) * g1 s.

Lemma K2_derive s : is_derive K2 s (K2' s).
Proof.
apply/is_derive_Reals.
have -> : K2' s = 2 * f' q1 q2 s + (-4 * g s + 4 * (R2 - s) * g1 s) by rewrite /K2' g_f; ring.
apply: (derivable_pt_lim_plus (fun s => 2 * f q1 q2 s) (fun s => 4 * (R2 - s) * g s)).
  by apply: derivable_pt_lim_scal; apply/is_derive_Reals; exact: f_derive.
apply: (derivable_pt_lim_mult (fun s => 4 * (R2 - s)) g); last by apply/is_derive_Reals/g_derive.
by apply/is_derive_Reals; auto_derive => //; ring.
Qed.

(* What the code asks of one s, q2 s^2 being `square` there. *)
Definition rises s := 3 * (T s - 1) <
  2 * (R2 - s) * q2 * s * (4 * (tanh' s + q2 * (s * s) / 2 * (1 - tanh' s * tanh' s)) - 2 * tanh' s * (T s - 1)).

Definition rho s := - (2 * q2 * s * tanh' s) + log_slope s * (1 + / (T s - 1)).

Lemma g1_rho s : 0 < s -> 1 < T s -> g1 s = g s * rho s.
Proof. by move=> s0 T0; rewrite /g1 (T1_log s0) /g /rho; field; lra. Qed.

Lemma rises_rho s : 0 < s -> 1 < T s -> rises s <-> 6 < 4 * (R2 - s) * rho s.
Proof.
move=> s0 T0; have e0 := e_pos s.
have E : rho s * (T s - 1) =
    q2 * s * (4 * (tanh' s + q2 * (s * s) / 2 * (1 - tanh' s * tanh' s)) - 2 * tanh' s * (T s - 1)).
  have -> : rho s * (T s - 1) = - (2 * q2 * s * tanh' s) * (T s - 1) + T1 s.
    by rewrite (T1_log s0) /rho; field; lra.
  by rewrite /T1 /tanh'; field; lra.
rewrite /rises; have -> : 2 * (R2 - s) * q2 * s * (4 * (tanh' s + q2 * (s * s) / 2 * (1 - tanh' s * tanh' s)) -
    2 * tanh' s * (T s - 1)) = 2 * (R2 - s) * (rho s * (T s - 1)) by rewrite E; ring.
have p : 0 < T s - 1 by lra.
split=> h.
  apply: (Rmult_lt_reg_r (T s - 1)) => //; lra.
have := Rmult_lt_compat_r _ _ _ p h; lra.
Qed.

Lemma K_before s : T s <= 1 -> K s = 2 * f q1 q2 s.
Proof.
move=> le; rewrite /K /curvature.K Rmax_left; first by ring.
by rewrite -g_f /g; have := front_nonneg s; nra.
Qed.

Lemma K_after s : 1 <= T s -> K s = K2 s.
Proof.
move=> ge; rewrite /K /curvature.K /K2 g_f Rmax_right //.
by rewrite -g_f /g; apply: Rmult_le_pos; [exact: front_nonneg | lra].
Qed.

Variable star : R.
Hypothesis star_nonneg : 0 <= star.
Hypothesis turns : T star = 1.

Lemma star_pos : 0 < star.
Proof.
case: star_nonneg => [// | E]; move: turns; rewrite -E T_tanh !Rmult_0_r Rmult_0_l; lra.
Qed.

Lemma T_after s : star <= s -> 1 <= T s.
Proof. by move=> le; rewrite -turns; apply: turn_mono => //; split. Qed.

Lemma T_before s : 0 <= s <= star -> T s <= 1.
Proof. by move=> le; rewrite -turns; exact: turn_mono. Qed.

Lemma T_beyond s : star < s -> 1 < T s.
Proof.
move=> lt; have p := star_pos; have m := tanh_mono (s := star) (t := s) ltac:(lra).
have t0 : 0 < tanh' star.
  have e1 := e_below p; have e0 := e_pos star; apply: Rmult_lt_0_compat; [lra | apply: Rinv_0_lt_compat; lra].
move: turns; rewrite !T_tanh => <-.
have sq : star * star < s * s by nra.
apply: (Rlt_le_trans _ (2 * q2 * (s * s) * tanh' star)); last by apply: Rmult_le_compat_l => //; nra.
by apply: Rmult_lt_compat_r => //; nra.
Qed.

Lemma rho_falls s t : star < s -> s <= t -> rho t <= rho s.
Proof.
move=> ss st; have p := star_pos; have s0 : 0 < s by lra.
have Ts := T_beyond ss; have Tt : 1 < T t by apply: T_beyond; lra.
have TT : T s <= T t by apply: turn_mono => //; lra.
have [l0 l1] := log_slope_falls s0 st.
have i0 : 0 < / (T t - 1) by apply: Rinv_0_lt_compat; lra.
have i1 : / (T t - 1) <= / (T s - 1) by apply: Rinv_le_contravar; lra.
have [a0 _] := @tanh_range s (Rlt_le _ _ s0); have m := tanh_mono (s := s) (t := t) ltac:(lra).
have first : s * tanh' s <= t * tanh' t by apply: Rmult_le_compat; lra.
have second : log_slope t * (1 + / (T t - 1)) <= log_slope s * (1 + / (T s - 1)).
  by apply: Rmult_le_compat; lra.
rewrite /rho; have : 2 * q2 * (s * tanh' s) <= 2 * q2 * (t * tanh' t) by apply: Rmult_le_compat_l; lra.
lra.
Qed.

(* Once K rises at s it rises all the way to it. *)
Lemma rises_before s t : star < s -> s <= t -> t <= R2 -> rises t -> rises s.
Proof.
move=> ss st tR; have p := star_pos; have s0 : 0 < s by lra.
have Ts := T_beyond ss; have Tt : 1 < T t by apply: T_beyond; lra.
rewrite !rises_rho //; try lra; move=> h; have m := rho_falls ss st.
have r0 : 0 < rho t by nra.
have : (R2 - t) * rho t <= (R2 - s) * rho s by apply: Rmult_le_compat; lra.
lra.
Qed.

Lemma slope_at s : star < s -> K2' s = g s * (4 * (R2 - s) * rho s - 6).
Proof. by move=> ss; have p := star_pos; rewrite /K2' g1_rho; [ring | lra | exact: T_beyond]. Qed.

Lemma g_beyond s : star < s -> 0 <= g s.
Proof. by move=> ss; apply: Rmult_le_pos; [exact: front_nonneg | have := T_beyond ss; lra]. Qed.

Lemma mean a b : a < b -> exists c, a < c < b /\ K2 b - K2 a = K2' c * (b - a).
Proof.
move=> ab; have [c [E cin]] : exists c, K2 b - K2 a = K2' c * (b - a) /\ a < c < b.
  by apply: MVT_cor2 => // c cin; apply/is_derive_Reals/K2_derive.
by exists c.
Qed.

Lemma up_after a b : star <= a -> a <= b -> (forall c, a < c < b -> rises c) -> K a <= K b.
Proof.
move=> sa [ab | ->] all; last lra.
rewrite !K_after; try (apply: T_after; lra); have [c [cin E]] := mean ab.
have ss : star < c by lra.
have p := star_pos; have := all c cin; rewrite rises_rho; [| lra | exact: T_beyond].
rewrite (slope_at ss) in E => h; have g0 := g_beyond ss.
have : 0 <= g c * (4 * (R2 - c) * rho c - 6) * (b - a) by apply: Rmult_le_pos; [apply: Rmult_le_pos; lra | lra].
lra.
Qed.

Lemma down_after a b : star <= a -> a <= b -> (forall c, a < c < b -> ~ rises c) -> K b <= K a.
Proof.
move=> sa [ab | ->] all; last lra.
rewrite !K_after; try (apply: T_after; lra); have [c [cin E]] := mean ab.
have ss : star < c by lra.
have p := star_pos; have := all c cin; rewrite rises_rho; [| lra | exact: T_beyond].
rewrite (slope_at ss) in E => h; have g0 := g_beyond ss.
have : 0 <= g c * (6 - 4 * (R2 - c) * rho c) * (b - a) by apply: Rmult_le_pos; [apply: Rmult_le_pos; lra | lra].
lra.
Qed.

Lemma up_before a b : 0 <= a -> a <= b -> b <= star -> K a <= K b.
Proof.
move=> a0 ab bs; rewrite !K_before; try (apply: T_before; lra).
have := before q1_nonneg q2_pos turns a0 ab bs; lra.
Qed.

Definition peak_of hat := (forall a b, 0 <= a -> a <= b -> b <= hat -> K a <= K b) /\
  (forall a b, hat <= a -> a <= b -> b <= R2 -> K b <= K a).

(* Whatever is known to rise up to l and not to rise at h: a peak lies between. *)
Theorem peak_between l h : star <= l <= h -> h <= R2 -> (l = star \/ rises l) -> (h = R2 \/ (star < h /\ ~ rises h)) ->
  exists hat, l <= hat <= h /\ peak_of hat.
Proof.
move=> [sl lh] hR low high.
pose E s := star <= s <= R2 /\ (s = star \/ rises s).
have El : E l by split; [lra | exact: low].
have bound : is_upper_bound E h.
  move=> s [[s0 sR] which]; case: (Rle_lt_dec s h) => // hs.
  case: which => [-> | up]; first lra.
  case: high => [-> // | [c no]]; by case: no; apply: (rises_before c (Rlt_le _ _ hs) sR up).
have [hat [upper least]] : {hat | is_lub E hat} by apply: completeness; [exists h | exists l].
have lhat : l <= hat by exact: upper.
have hath : hat <= h by exact: least.
have below c : star < c -> c < hat -> rises c.
  move=> sc ch; case: (Rlt_le_dec (3 * (T c - 1)) (2 * (R2 - c) * q2 * c * (4 * (tanh' c + q2 * (c * c) / 2 * (1 - tanh' c * tanh' c)) - 2 * tanh' c * (T c - 1)))) => // no'.
  have no : ~ rises c by rewrite /rises; lra.
  have : hat <= c; last lra.
  apply: least => s [[s0 sR] which]; case: (Rle_lt_dec s c) => // cs.
  case: which => [-> | up]; first lra.
  by case: no; apply: (rises_before sc (Rlt_le _ _ cs) sR up).
have above c : hat < c -> c <= R2 -> ~ rises c.
  move=> hc cR up; have : c <= hat; last lra.
  by apply: upper; split; [lra | right].
exists hat; split; [lra | split].
  move=> a b a0 ab bh; case: (Rle_lt_dec b star) => bs; first exact: up_before.
  case: (Rle_lt_dec star a) => sa; first by apply: up_after => // c cin; apply: below; lra.
  apply: (Rle_trans _ (K star)); first by apply: up_before; lra.
  by apply: up_after; [lra | lra | move=> c cin; apply: below; lra].
move=> a b ha ab bR; apply: down_after; [lra | lra |] => c cin; apply: above; lra.
Qed.

Theorem test_yes s a b : star < s <= R2 -> rises s -> 0 <= a -> a <= b -> b <= s -> K a <= K b.
Proof.
move=> [ss sR] up a0 ab bs.
have [hat [[sh _] [rise _]]] : exists hat, s <= hat <= R2 /\ peak_of hat.
  by apply: peak_between; [lra | lra | right | left].
by apply: rise; lra.
Qed.

Theorem test_no s a b : star < s <= R2 -> ~ rises s -> s <= a -> a <= b -> b <= R2 -> K b <= K a.
Proof.
move=> [ss sR] no sa ab bR.
have [hat [[_ hs] [_ fall]]] : exists hat, star <= hat <= s /\ peak_of hat.
  by apply: peak_between; [lra | lra | left | right; split; [lra |]].
by apply: fall; lra.
Qed.

(* eq:curvature-bound: also where f has no peak within R. *)
Theorem single_peak : 0 <= R2 -> exists hat, 0 <= hat <= R2 /\ peak_of hat.
Proof.
move=> R0; case: (Rle_lt_dec star R2) => sR.
  have [hat [hin p]] : exists hat, star <= hat <= R2 /\ peak_of hat.
    by apply: peak_between; [lra | lra | left | left].
  by exists hat; split => //; have := star_pos; lra.
exists R2; split; [lra | split] => a b h1 h2 h3; first by apply: up_before; lra.
have -> : a = b by lra.
exact: Rle_refl.
Qed.

Theorem largest_bend hat lo hi s : peak_of hat -> 0 <= lo -> hi <= R2 -> lo <= s <= hi ->
  K s <= K (Rmax lo (Rmin hi hat)).
Proof.
move=> [rise fall] lo0 hiR [l h]; case: (Rle_lt_dec hat lo) => sl.
  by rewrite Rmax_left; [apply: fall; lra | apply: Rle_trans (Rmin_r _ _) sl].
case: (Rle_lt_dec hi hat) => hs.
  by rewrite (Rmin_left hi hat) // Rmax_right; [apply: rise; lra | lra].
rewrite (Rmin_right hi hat); last lra.
rewrite Rmax_right; last lra.
by case: (Rle_lt_dec s hat) => ss; [apply: rise; lra | apply: fall; lra].
Qed.
End Bend.

(* Where f is largest: z = q2 s^2/2 with 4 z tanh z = 1. *)
Definition steepest_z := 0.5218134477957685.

Theorem steepest q2 : 0 < q2 -> exists star, 0 <= star /\ turn q2 star = 1 /\
  Rabs (q2 * (star * star) / 2 - steepest_z) <= 1 / 10 ^ 15.
Proof.
move=> q0; pose gap z := 4 * z * (1 - exp (- (2 * z))) - (1 + exp (- (2 * z))).
have low : gap (steepest_z - 1 / 10 ^ 15) < 0 by rewrite /gap /steepest_z; interval with (i_prec 120).
have high : 0 < gap (steepest_z + 1 / 10 ^ 15) by rewrite /gap /steepest_z; interval with (i_prec 120).
have [z [[z0 z1] E]] : {z | steepest_z - 1 / 10 ^ 15 <= z <= steepest_z + 1 / 10 ^ 15 /\ gap z = 0}.
  by apply: IVT_cor; [rewrite /gap; reg | lra | nra].
have zp : 0 < z by move: z0; rewrite /steepest_z; lra.
have w0 : 0 <= 2 * z / q2 by apply: Rmult_le_pos; [lra | apply/Rlt_le/Rinv_0_lt_compat].
exists (sqrt (2 * z / q2)); split; first exact: sqrt_pos.
have sq := sqrt_sqrt _ w0; have zE : q2 * (sqrt (2 * z / q2) * sqrt (2 * z / q2)) = 2 * z by rewrite sq; field; lra.
split; last by rewrite zE; apply: Rabs_le; lra.
have two : 2 * q2 * (sqrt (2 * z / q2) * sqrt (2 * z / q2)) = 2 * (q2 * (sqrt (2 * z / q2) * sqrt (2 * z / q2))) by ring.
rewrite /turn two zE.
have e0 := exp_pos (- (2 * z)); apply: (Rmult_eq_reg_r (1 + exp (- (2 * z)))); last lra.
have -> : 2 * (2 * z) * (1 - exp (- (2 * z))) / (1 + exp (- (2 * z))) * (1 + exp (- (2 * z))) =
  2 * (2 * z) * (1 - exp (- (2 * z))) by field; lra.
move: E; rewrite /gap; lra.
Qed.
