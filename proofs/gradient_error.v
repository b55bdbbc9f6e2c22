(* What a gradient is wrong by if an offset is (docs/theory/weights.md, eq:gradient-error).

   In words. The gradient of a weight at the offset r is G(r) = - 2 f(R^2 - |r|^2) r, and 0 out of range. If r is wrong by w, G is wrong by at most M |w|, where M is at
   least K(s), and at least the eigenvalue of the Hessian along r, 4 (R^2 - s) f'(s) - 2 f(s), called `swell`, for each s >= 0 on the way from r to r + w
   (`gradient_moved`). The way may lead out of range and back.

   `swell_falls`: as long as it is positive, `swell` falls with s. So on an interval of s it is largest at the low end, which is the farthest distance.

   `gradient_error` is eq:gradient-error: for an offset of length d that is wrong by at most e, G is wrong by at most M e, with M the larger of K at the point
   of [low, high] closest to its peak and of `swell` at low, where low = max(0, R^2 - (d + e)^2) and high = R^2 - max(0, d - e)^2; and not at all if high <= 0.
   Squares of lengths stand for lengths. *)

From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import vectors weights curvature peak bend_peak.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Section Gradient.
Variables q1 q2 R2 : R.
Hypothesis q1_nonneg : 0 <= q1.
Hypothesis q2_pos : 0 < q2.
Let K := curvature.K q1 q2 R2.
Let f := weights.f q1 q2.
Let f' := curvature.f' q1 q2.

(* The eigenvalue of the Hessian along r. *)
Definition swell s := 4 * (R2 - s) * f' s - 2 * f s.

Lemma f_zero : f 0 = 0.
Proof. by rewrite /f /weights.f !Rmult_0_r /Rdiv !Rmult_0_l. Qed.

(* |H w| <= M |w| for the Hessian H = - 2 f + 4 f' x x^T, with D = |x|^2, c = |w|^2 and y = (x.w)^2. *)
Lemma stretch D c y g h M : 0 <= D -> 0 <= c -> 0 <= y -> y <= D * c -> 0 <= h -> h <= M -> - M <= 4 * D * g - h <= M ->
  16 * (g * g) * y * D - 8 * h * g * y + h * h * c <= M * M * c.
Proof.
move=> D0 c0 y0 yc h0 hM [low high]; have hh : h * h <= M * M by nra.
case: (Req_dec D 0) => [z | Dn].
  have -> : y = 0 by rewrite z Rmult_0_l in yc; lra.
  rewrite !Rmult_0_r Rmult_0_l; nra.
apply: (Rmult_le_reg_l D); first lra.
have -> : D * (16 * (g * g) * y * D - 8 * h * g * y + h * h * c) = h * h * (D * c - y) + (4 * D * g - h) * (4 * D * g - h) * y by ring.
have sq : (4 * D * g - h) * (4 * D * g - h) <= M * M by nra.
have e1 : h * h * (D * c - y) <= M * M * (D * c - y) by apply: Rmult_le_compat_r; lra.
have e2 : (4 * D * g - h) * (4 * D * g - h) * y <= M * M * y by exact: Rmult_le_compat_r.
lra.
Qed.

Section Way.
Variables (d : nat) (r w : vec d).
Let s t := R2 - (sq r + 2 * t * dot r w + t * t * sq w).
Let x t : vec d := plus r (times t w).
Variable M : R.
Hypothesis bend : forall t, 0 <= t <= 1 -> 0 <= s t -> K (s t) <= M.
Hypothesis grow : forall t, 0 <= t <= 1 -> 0 <= s t -> swell (s t) <= M.
Let G := @gradient q1 q2 R2 d.

Lemma sq_way t : sq (x t) = R2 - s t.
Proof. by rewrite /x sq_plus dot_times_r sq_times /s; ring. Qed.

Lemma G_in t : 0 <= s t -> G (x t) = times (-2 * f (s t)) (x t).
Proof. by move=> s0; rewrite /G /gradient sq_way Rmax_left; [have -> : R2 - (R2 - s t) = s t by ring | lra]. Qed.

Lemma G_out t : s t <= 0 -> G (x t) =1 fun _ => 0.
Proof. by move=> s0 c; rewrite /G /gradient sq_way Rmax_right; [rewrite -/f f_zero /times Rmult_0_r Rmult_0_l | lra]. Qed.

Lemma hessian (v : vec d) t : 0 <= t <= 1 -> 0 <= s t ->
  let phi1 := 4 * f' (s t) * dot (x t) w * dot (x t) v - 2 * f (s t) * dot w v in phi1 * phi1 <= M * M * sq w * sq v.
Proof.
move=> t01 s0 phi1.
pose H : vec d := plus (times (4 * f' (s t) * dot (x t) w) (x t)) (times (-2 * f (s t)) w).
have E : phi1 = dot H v by rewrite /H dot_plus !dot_times /phi1; ring.
have f0 : 0 <= f (s t) by exact: f_nonneg.
have cs := cauchy_schwarz H v; rewrite -E in cs; apply: Rle_trans cs _.
apply: Rmult_le_compat_r; first exact: sq_nonneg.
have -> : sq H = 16 * (f' (s t) * f' (s t)) * (dot (x t) w * dot (x t) w) * sq (x t)
    - 8 * (2 * f (s t)) * f' (s t) * (dot (x t) w * dot (x t) w) + 2 * f (s t) * (2 * f (s t)) * sq w.
  by rewrite /H sq_plus !sq_times dot_times dot_times_r; ring.
have low := bend t01 s0; have high := grow t01 s0; rewrite /swell in high; rewrite /K /curvature.K -/f -/f' in low.
have D0 := sq_nonneg (x t); rewrite sq_way in D0.
have m0 := Rmax_l 0 (- f' (s t)); have m1 := Rmax_r 0 (- f' (s t)).
have p0 : 0 <= (R2 - s t) * Rmax 0 (- f' (s t)) by exact: Rmult_le_pos.
have p1 : (R2 - s t) * - f' (s t) <= (R2 - s t) * Rmax 0 (- f' (s t)) by exact: Rmult_le_compat_l.
apply: stretch; rewrite ?sq_way; [exact: D0 | exact: sq_nonneg | nra | rewrite -sq_way; exact: cauchy_schwarz | lra | lra | split; lra].
Qed.

Lemma phi_derive (v : vec d) t : is_derive (fun t => -2 * f (s t) * (dot r v + t * dot w v)) t
  (4 * f' (s t) * dot (x t) w * dot (x t) v - 2 * f (s t) * dot w v).
Proof.
have lin : derivable_pt_lim (fun t => dot r v + t * dot w v) t (dot w v).
  by apply/is_derive_Reals; auto_derive => //; ring.
have outer : derivable_pt_lim (fun t => -2 * f (s t)) t (-2 * (f' (s t) * (-2 * (dot r w + t * sq w)))).
  apply: derivable_pt_lim_scal; apply: (derivable_pt_lim_comp s f); first exact: s_derive.
  by apply/is_derive_Reals; exact: f_derive.
have := derivable_pt_lim_mult _ _ _ _ _ outer lin; rewrite /mult_fct => h; apply/is_derive_Reals.
have -> : 4 * f' (s t) * dot (x t) w * dot (x t) v - 2 * f (s t) * dot w v =
  -2 * (f' (s t) * (-2 * (dot r w + t * sq w))) * (dot r v + t * dot w v) + -2 * f (s t) * dot w v.
  by rewrite /x !dot_plus !dot_times /sq; ring.
exact: h.
Qed.

(* Where both ends are in range. *)
Lemma moved_inside a b : 0 <= a <= b -> b <= 1 -> 0 <= s a -> 0 <= s b -> (forall t, a <= t <= b -> 0 <= s t) ->
  sq (minus (G (x b)) (G (x a))) <= M * M * ((b - a) * (b - a) * sq w).
Proof.
move=> [a0 ab] b1 sa sb inside; case: ab => [ab | E]; last first.
  have -> : sq (minus (G (x b)) (G (x a))) = 0.
    by rewrite E /sq /dot big1 // => c _; rewrite /minus; ring.
  by rewrite E; have -> : b - b = 0 by [ring]; lra.
set v := minus _ _.
pose phi t := -2 * f (s t) * (dot r v + t * dot w v).
have phi_is t : 0 <= s t -> dot (G (x t)) v = phi t.
  by move=> st; rewrite G_in // dot_times /x dot_plus dot_times /phi.
have [c [E cin]] : exists c, phi b - phi a = (4 * f' (s c) * dot (x c) w * dot (x c) v - 2 * f (s c) * dot w v) * (b - a) /\ a < c < b.
  by apply: MVT_cor2 => // c cin; apply/is_derive_Reals; exact: phi_derive.
have h := hessian v (t := c) ltac:(lra) (inside c ltac:(lra)); move: h E => /=.
set p := (4 * _ * _ * _ - _) => h E.
have vv : sq v = p * (b - a) by rewrite -E -!phi_is // -dot_minus.
have v0 := sq_nonneg v; case: (Req_dec (sq v) 0) => [z | vn].
  rewrite z; have w0 := sq_nonneg w; have : 0 <= (b - a) * (b - a) * sq w by apply: Rmult_le_pos => //; nra.
  by move=> k0; apply: Rmult_le_pos => //; nra.
apply: (Rmult_le_reg_r (sq v)); first lra.
have -> : sq v * sq v = p * p * ((b - a) * (b - a)) by rewrite {1 2}vv; ring.
have bb : 0 <= (b - a) * (b - a) by nra.
have := Rmult_le_compat_r _ _ _ bb h; lra.
Qed.

Lemma sq_ext (u v : vec d) : u =1 v -> sq u = sq v.
Proof. by move=> E; exact: dot_ext. Qed.

Lemma at_0 : x 0 =1 r. Proof. by move=> c; rewrite /x /plus /times; ring. Qed.
Lemma at_1 : x 1 =1 plus r w. Proof. by move=> c; rewrite /x /plus /times; ring. Qed.

Lemma G_ext (u v : vec d) : u =1 v -> G u =1 G v.
Proof. by move=> E c; rewrite /G /gradient (sq_ext E) /times E. Qed.

Lemma between_ends a b : 0 <= a <= b -> b <= 1 -> 0 <= s a -> 0 <= s b -> forall t, a <= t <= b -> 0 <= s t.
Proof.
move=> [a0 ab] b1 sa sb t [at_ tb]; have c0 := sq_nonneg w.
case: (Req_dec a b) => [E | ne]; first by have -> : t = a by lra.
have key : 0 <= (b - a) * s t - ((b - t) * s a + (t - a) * s b).
  have -> : (b - a) * s t - ((b - t) * s a + (t - a) * s b) = sq w * ((b - t) * (t - a) * (b - a)) by rewrite /s; ring.
  by apply: Rmult_le_pos => //; apply: Rmult_le_pos; nra.
have : 0 <= (b - t) * s a + (t - a) * s b by nra.
move=> h; apply: (Rmult_le_reg_l (b - a)); [lra | rewrite Rmult_0_r; lra].
Qed.

Theorem gradient_moved : 0 <= M -> sq (minus (G (plus r w)) (G r)) <= M * M * sq w.
Proof.
move=> M0.
have -> : sq (minus (G (plus r w)) (G r)) = sq (minus (G (x 1)) (G (x 0))).
  by apply: sq_ext => c; rewrite /minus (G_ext at_1) (G_ext at_0).
have w0 := sq_nonneg w; have mm : 0 <= M * M by nra.
have part q : 0 <= q <= 1 -> M * M * (q * q * sq w) <= M * M * sq w.
  move=> q01; have qq : q * q <= 1 by nra.
  by apply: Rmult_le_compat_l => //; have := Rmult_le_compat_r _ _ _ w0 qq; lra.
case: (Rle_lt_dec 0 (s 0)) => s0; case: (Rle_lt_dec 0 (s 1)) => s1.
- have := @moved_inside 0 1 ltac:(lra) ltac:(lra) s0 s1 (@between_ends 0 1 ltac:(lra) ltac:(lra) s0 s1); have := part (1 - 0) ltac:(lra); lra.
- have [t [[t0 t1] st]] : {t | 0 <= t <= 1 /\ s t = 0} by apply: IVT_cor; [rewrite /s; reg | lra | nra].
  have st0 : 0 <= s t by lra.
  have -> : sq (minus (G (x 1)) (G (x 0))) = sq (minus (G (x t)) (G (x 0))).
    by apply: sq_ext => c; rewrite /minus (@G_out 1) ?(@G_out t) //; lra.
  have := @moved_inside 0 t ltac:(lra) t1 s0 st0 (@between_ends 0 t ltac:(lra) t1 s0 st0); have := part (t - 0) ltac:(lra); lra.
- have [t [[t0 t1] st]] : {t | 0 <= t <= 1 /\ s t = 0} by apply: IVT_cor; [rewrite /s; reg | lra | nra].
  have st0 : 0 <= s t by lra.
  have -> : sq (minus (G (x 1)) (G (x 0))) = sq (minus (G (x 1)) (G (x t))).
    by apply: sq_ext => c; rewrite /minus (@G_out 0) ?(@G_out t) //; lra.
  have := @moved_inside t 1 ltac:(lra) ltac:(lra) st0 s1 (@between_ends t 1 ltac:(lra) ltac:(lra) st0 s1); have := part (1 - t) ltac:(lra); lra.
- have -> : sq (minus (G (x 1)) (G (x 0))) = 0.
    by rewrite /sq /dot big1 // => c _; rewrite /minus !G_out; lra.
  by apply: Rmult_le_pos.
Qed.
End Way.

(* The convex eigenvalue falls while it is positive. *)
Theorem swell_falls lo s : 0 <= lo -> lo <= s -> s <= R2 -> swell s <= Rmax 0 (swell lo).
Proof.
move=> lo0 ls sR; case: (Rle_lt_dec (swell s) 0) => sw; first by apply: Rle_trans sw (Rmax_l _ _).
apply: Rle_trans (Rmax_r _ _); move: sw; rewrite /swell => sw.
have fs : 0 <= f s by apply: f_nonneg; lra.
have fl : 0 <= f lo by exact: f_nonneg.
have up : 0 < f' s.
  by case: (Rle_lt_dec (f' s) 0) => // neg; have : (R2 - s) * f' s <= (R2 - s) * 0 by [apply: Rmult_le_compat_l; lra]; lra.
have turn_s : turn q2 s < 1.
  case: (Rlt_le_dec (turn q2 s) 1) => // ge; move: up; rewrite /f' f'_turn.
  have := @peak.front q1 q2 q1_nonneg q2_pos s; set g := (_ / _) => g0 up.
  have : g * (turn q2 s - 1) >= 0 by apply: Rle_ge; apply: Rmult_le_pos; lra.
  lra.
have rising c : lo <= c <= s -> 0 <= f' c.
  move=> cin; rewrite /f' f'_turn; have m := @turn_mono q2 q2_pos c s ltac:(lra).
  by apply: Rmult_le_pos; [exact: (peak.front q1_nonneg q2_pos) | lra].
have ff : f lo <= f s.
  have [c [cin E]] := @between q1 q2 lo s ls; rewrite -/f -/f' in E.
  have : 0 <= f' c * (s - lo) by apply: Rmult_le_pos; [exact: rising | lra].
  lra.
have gg : f' s <= f' lo.
  rewrite /f' !f'_turn; have m := @turn_mono q2 q2_pos lo s ltac:(lra).
  apply: Rmult_le_compat; [exact: (peak.front q1_nonneg q2_pos) | lra | | lra].
  set a := exp (- (q2 * (s * s))); set b := exp (- (q2 * (lo * lo))).
  have a0 : 0 < a by exact: exp_pos.
  have sq : lo * lo <= s * s by nra.
  have ab : a <= b.
    case: (Req_dec (lo * lo) (s * s)) => [E | ne]; first by rewrite /a /b E; lra.
    by apply/Rlt_le/exp_increasing; nra.
  have b1 : b <= 1.
    have le : - (q2 * (lo * lo)) <= 0 by nra.
    by rewrite -exp_0 /b; case: le => [lt | ->]; [apply/Rlt_le/exp_increasing | apply: Rle_refl].
  have qq : 0 <= 2 * q1 * q2 by nra.
  apply: (Rmult_le_reg_r ((1 + a) * (1 + a) * ((1 + b) * (1 + b)))); first by apply: Rmult_lt_0_compat; nra.
  have -> : 2 * q1 * q2 * a / ((1 + a) * (1 + a)) * ((1 + a) * (1 + a) * ((1 + b) * (1 + b))) = 2 * q1 * q2 * (a * ((1 + b) * (1 + b))) by field; lra.
  have -> : 2 * q1 * q2 * b / ((1 + b) * (1 + b)) * ((1 + a) * (1 + a) * ((1 + b) * (1 + b))) = 2 * q1 * q2 * (b * ((1 + a) * (1 + a))) by field; lra.
  apply: Rmult_le_compat_l => //.
  have : 0 <= (b - a) * (1 - a * b) by apply: Rmult_le_pos; nra.
  lra.
have : (R2 - s) * f' s <= (R2 - lo) * f' lo by apply: Rmult_le_compat; lra.
lra.
Qed.

(* eq:gradient-error *)
Theorem gradient_error (n : nat) (r w : vec n) hat d e : peak_of q1 q2 R2 hat -> 0 <= d -> sq r = d * d -> 0 <= e -> sq w <= e * e ->
  let low := Rmax 0 (R2 - (d + e) * (d + e)) in
  let high := R2 - Rmax 0 (d - e) * Rmax 0 (d - e) in
  let M := if Rle_dec high 0 then 0 else Rmax (K (Rmax low (Rmin high hat))) (swell low) in
  sq (minus (@gradient q1 q2 R2 n (plus r w)) (@gradient q1 q2 R2 n r)) <= M * M * (e * e).
Proof.
move=> peak d0 rd e0 we low high M.
have w0 := sq_nonneg w; have l0 := sqrt_pos (sq w); have ll := sqrt_sqrt _ w0; set l := sqrt (sq w) in l0 ll.
have le_ : l <= e by apply: Rsqr_incr_0_var => //; rewrite /Rsqr ll.
have cs := cauchy_schwarz r w; rewrite rd -ll in cs.
have dl : 0 <= d * l by exact: Rmult_le_pos.
have [b1 b2] : - (d * l) <= dot r w <= d * l by apply/Rabs_le_between; rewrite -(Rabs_pos_eq _ dl); apply: Rsqr_le_abs_0; rewrite /Rsqr; lra.
pose s t := R2 - (sq r + 2 * t * dot r w + t * t * sq w).
have range t : 0 <= t <= 1 -> R2 - (d + e) * (d + e) <= s t <= high.
  move=> [t0 t1]; rewrite /s rd -ll /high; have tl : 0 <= t * l <= e by split; nra.
  have u1 : t * dot r w <= t * (d * l) by exact: Rmult_le_compat_l.
  have u2 : t * - (d * l) <= t * dot r w by exact: Rmult_le_compat_l.
  split.
    have : (d + t * l) * (d + t * l) <= (d + e) * (d + e) by apply: Rmult_le_compat; lra.
    lra.
  have : Rmax 0 (d - e) * Rmax 0 (d - e) <= (d - t * l) * (d - t * l).
    rewrite /Rmax; case: (Rle_dec 0 (d - e)) => h; last by rewrite Rmult_0_l; exact: Rle_0_sqr.
    by apply: Rmult_le_compat; lra.
  lra.
have ee : 0 <= e * e by nra.
case E : (Rle_dec high 0) => [out | inn].
  have zero t : 0 <= t <= 1 -> s t <= 0 by move=> t01; have := range t t01; lra.
  have Z0 := @G_out n r w 0 (zero 0 ltac:(lra)); have Z1 := @G_out n r w 1 (zero 1 ltac:(lra)).
  have -> : sq (minus (@gradient q1 q2 R2 n (plus r w)) (@gradient q1 q2 R2 n r)) = 0.
    rewrite /sq /dot big1 // => c _; rewrite /minus.
    by rewrite -(G_ext (at_1 r w)) -(G_ext (at_0 r w)) Z0 Z1; ring.
  by rewrite /M E !Rmult_0_l; lra.
have hR : high <= R2 by rewrite /high; have := Rmax_l 0 (d - e); nra.
have low0 : 0 <= low by exact: Rmax_l.
have in_ t : 0 <= t <= 1 -> 0 <= s t -> low <= s t <= high.
  by move=> t01 st; have := range t t01; split; [apply: Rmax_lub; lra | lra].
have bend t : 0 <= t <= 1 -> 0 <= s t -> K (s t) <= M.
  move=> t01 st; rewrite /M E; apply: Rle_trans (Rmax_l _ _).
  by apply: (largest_bend peak low0 hR); exact: in_.
have pos : 0 <= M.
  rewrite /M E; apply: Rle_trans (Rmax_l _ _); set p := Rmax low _.
  have lh : low <= high.
    rewrite /low; apply: Rmax_lub; first lra.
    by have := range 0 ltac:(lra); lra.
  have p0 : 0 <= p by apply: Rle_trans low0 (Rmax_l _ _).
  have pR : p <= R2 by rewrite /p; apply: Rmax_lub; [lra | apply: Rle_trans (Rmin_l _ _) hR].
  rewrite /K /curvature.K; have := f_nonneg q1_nonneg q2_pos p0; have := Rmax_l 0 (- curvature.f' q1 q2 p); nra.
have grow t : 0 <= t <= 1 -> 0 <= s t -> swell (s t) <= M.
  move=> t01 st; have [h1 h2] := in_ t t01 st; have := @swell_falls low (s t) low0 h1 ltac:(lra) => h; apply: Rle_trans h _.
  by apply: Rmax_lub => //; rewrite /M E; exact: Rmax_r.
have := @gradient_moved n r w M bend grow pos => h; apply: Rle_trans h _.
by apply: Rmult_le_compat_l => //; nra.
Qed.
End Gradient.
