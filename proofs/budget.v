(* The controller budget: one tick (docs/theory/budget.md, thm:discrete, sec:shares).

   In words. h_k is the sum of the link weights of robot k to those that count for it, less its need. If every robot applies
   a move that meets its rows, all of them with (far') or all of them with (far), if the neighbours i of k use b_ik <= max(h_k, 0)
   and shares of at least 1/(degree of k + 1), then h_k' >= h_k - s(max(h_k, 0)) after the tick, and after any part of every
   move. With (near) two robots keep D' - Dd^2 >= (1 - gamma_c)(D - Dd^2), and a pair out of range stays apart.

   Of the weight it is assumed: it is never negative, 0 out of range; for (far') the curvature bound kappa of
   eq:curvature-bound; for (far) the slope bound L of eq:slope-bound. curvature.v and weights.v prove both. Of s
   it is assumed that it never falls and is at least 0 (loss.v). *)

From Coq Require Import Reals Lra Psatz.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import vectors.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Definition pos (h : R) := Rmax h 0.
Lemma pos_nonneg h : 0 <= pos h. Proof. exact: Rmax_r. Qed.
Lemma pos_ge h : h <= pos h. Proof. exact: Rmax_l. Qed.

(* A row whose right-hand side is not negative is met by every part of a move that meets it. *)
Lemma row_of_part a b c t : 0 <= t <= 1 -> 0 <= b -> 0 <= c -> a + b <= c -> t * a + t * t * b <= c.
Proof.
move=> t01 b0 c0 row; have : 0 <= t * (1 - t) * b by apply: Rmult_le_pos; [nra | lra].
nra.
Qed.

(* (near), thm:discrete 2 *)
Section Near.
Variables (d : nat) (gamma_c Dd2 : R).
Hypothesis gamma_c01 : 0 < gamma_c <= 1.
Definition near_row (r v : vec d) := -2 * dot r v <= gamma_c / 2 * pos (sq r - Dd2).

Theorem near_tick (r v w : vec d) t u : 0 <= t <= 1 -> 0 <= u <= 1 ->
  near_row r v -> near_row (times (-1) r) w ->
  sq (moved r (times t v) (times u w)) - Dd2 >= sq r - Dd2 - gamma_c * pos (sq r - Dd2).
Proof.
move=> t01 u01; rewrite /near_row sq_times dot_times.
have -> : -1 * -1 * sq r = sq r by lra.
move=> rv rw; rewrite sq_moved !dot_times_r.
have := sq_nonneg (minus (times t v) (times u w)); have := pos_nonneg (sq r - Dd2).
move: (pos _) (sq (minus _ _)) (dot r v) (dot r w) rv rw => p z a b rv rw p0 z0.
have : t * (-2 * a) <= gamma_c / 2 * p.
  have := row_of_part t01 (Rle_refl 0); move=> /(_ (-2 * a) (gamma_c / 2 * p)) h.
  have c0 : 0 <= gamma_c / 2 * p by nra.
  have := h c0 ltac:(lra); lra.
have : u * (2 * b) <= gamma_c / 2 * p.
  have := row_of_part u01 (Rle_refl 0); move=> /(_ (2 * b) (gamma_c / 2 * p)) h.
  have c0 : 0 <= gamma_c / 2 * p by nra.
  have := h c0 ltac:(lra); lra.
lra.
Qed.

(* So a pair that is apart stays apart, and one that is closer than Dd does not come closer. *)
Corollary near_apart (r v w : vec d) t u : 0 <= t <= 1 -> 0 <= u <= 1 ->
  near_row r v -> near_row (times (-1) r) w ->
  (Dd2 <= sq r -> sq (moved r (times t v) (times u w)) - Dd2 >= (1 - gamma_c) * (sq r - Dd2)) /\
  (sq r <= Dd2 -> sq (moved r (times t v) (times u w)) >= sq r).
Proof.
move=> t01 u01 rv rw; have := near_tick t01 u01 rv rw; rewrite /pos => tick; split=> le.
  by move: tick; rewrite Rmax_left; lra.
by move: tick; rewrite Rmax_right; lra.
Qed.
End Near.

(* thm:discrete 2 for any pair: in range by the rows, out of range because nobody comes far in a tick. *)
Lemma pair_stays_apart (d : nat) gamma_c radius rho Dd (r v w : vec d) t u :
  0 < gamma_c <= 1 -> 0 <= rho -> 0 <= Dd -> Dd <= radius - 2 * rho -> 0 <= t <= 1 -> 0 <= u <= 1 ->
  sq v <= rho * rho -> sq w <= rho * rho ->
  (sq r <= radius * radius -> near_row gamma_c (Dd * Dd) r v /\ near_row gamma_c (Dd * Dd) (times (-1) r) w) ->
  Dd * Dd <= sq r -> Dd * Dd <= sq (moved r (times t v) (times u w)).
Proof.
move=> c01 rho0 Dd0 room t01 u01 lv lw rows apart.
case: (Rle_dec (sq r) (radius * radius)) => near.
  have [rv rw] := rows near; have [close _] := near_apart c01 t01 u01 rv rw.
  have := close apart; have : 0 <= (1 - gamma_c) * (sq r - Dd * Dd) by nra.
  lra.
rewrite /moved; apply: (far_apart rho0 Dd0 room); first exact: Rnot_le_lt.
have part (q : vec d) c : 0 <= c <= 1 -> sq q <= rho * rho -> sq (times c q) <= rho * rho.
  move=> c01' le; have := sq_nonneg q; rewrite sq_times; move: (sq q) le => z le z0.
  have : c * c <= 1 by nra.
  nra.
have := sq_minus_le (times t v) (times u w); have := part v t t01 lv; have := part w u u01 lw; lra.
Qed.

Section Far.
Variables (V : finType) (d : nat) (k : V).
Variable C : {set V}.             (* who counts for k *)
Variable N : {set V}.             (* those of them in range *)
Hypothesis NC : N \subset C.
Variable x : V -> vec d.          (* positions *)
Variable v : V -> vec d.          (* moves *)
Variable weight : V -> vec d -> R.   (* weight of the link of k to j at an offset *)
Hypothesis weight_nonneg : forall j r, 0 <= weight j r.
Definition r j : vec d := minus (x k) (x j).
Hypothesis out_of_range : forall j, j \in C -> j \notin N -> weight j (r j) = 0.
Variable t : V -> R.              (* the part of its move that each robot has done *)
Hypothesis t01 : forall j, 0 <= t j <= 1.
Variable need : R.
Definition h := \big[Rplus/0]_(j in C) weight j (r j) - need.
Definition after j := moved (r j) (times (t k) (v k)) (times (t j) (v j)).
Definition h' := \big[Rplus/0]_(j in C) weight j (after j) - need.
Variable s : R -> R.
Hypothesis s_nonneg : forall b, 0 <= b -> 0 <= s b.
Hypothesis s_mono : forall b c, 0 <= b -> b <= c -> s b <= s c.
Variables (b : V -> R) (share : V -> R).   (* what j counts on, and d_jk *)
Hypothesis b_true : forall j, j \in k |: N -> 0 <= b j <= pos h.
Hypothesis shares : forall j, j \in k |: N -> INR #|N| <= share j.

(* New links only add. *)
Lemma loss_of_links e : (forall j, j \in N -> weight j (after j) >= weight j (r j) - e j) ->
  h' >= h - \big[Rplus/0]_(j in N) e j.
Proof.
move=> each; have split_C f : \big[Rplus/0]_(j in C) f j =
    \big[Rplus/0]_(j in N) f j + \big[Rplus/0]_(j in C | j \notin N) f j.
  rewrite (bigID (fun j => j \in N)) /=; congr (_ + _).
  apply: eq_bigl => j; case jN : (j \in N); rewrite ?andbF ?andbT //; exact: (subsetP NC).
rewrite /h /h' !split_C.
have zero : \big[Rplus/0]_(j in C | j \notin N) weight j (r j) = 0.
  by rewrite (eq_bigr (fun=> 0)) ?sum_const ?Rmult_0_r // => j /andP [jC jN]; exact: out_of_range.
have new : 0 <= \big[Rplus/0]_(j in C | j \notin N) weight j (after j) by exact: sum_nonneg.
have old : \big[Rplus/0]_(j in N) weight j (r j) <=
           \big[Rplus/0]_(j in N) weight j (after j) + \big[Rplus/0]_(j in N) e j.
  by rewrite -sum_add; apply: sum_le => j jN; have := each j jN; lra.
lra.
Qed.

(* All shares of the neighbours, each at most c/(degree + 1), and one more make at most c. *)
Lemma shares_fit c (e : V -> R) e0 : 0 <= c -> e0 <= c / (INR #|N| + 1) ->
  (forall j, j \in N -> e j <= c / (INR #|N| + 1)) -> e0 + \big[Rplus/0]_(j in N) e j <= c.
Proof.
move=> c0 le0 le; have n0 := pos_INR #|N|.
have : \big[Rplus/0]_(j in N) e j <= INR #|N| * (c / (INR #|N| + 1)) by rewrite -sum_const; apply: sum_le.
have E : INR #|N| * (c / (INR #|N| + 1)) + c / (INR #|N| + 1) = c by field; lra.
lra.
Qed.

Lemma share_le j : j \in k |: N -> s (b j) / (share j + 1) <= s (pos h) / (INR #|N| + 1).
Proof.
move=> jN; have [b0 bh] := b_true jN; have le := shares jN; have n0 := pos_INR #|N|.
apply: Rmult_le_compat; [exact: s_nonneg | by apply/Rlt_le/Rinv_0_lt_compat; lra | exact: s_mono |].
by apply: Rinv_le_contravar; lra.
Qed.

(* (far'): gradients of the weight with respect to x_k, and curvature bounds. *)
Section FarPrime.
Variables (g : V -> vec d) (kappa : V -> R) (rho2 : R).
Hypothesis kappa0 : forall j, 0 <= kappa j.
Hypothesis bends : forall j w, j \in N -> sq w <= 4 * rho2 ->
  weight j (plus (r j) w) >= weight j (r j) + dot (g j) w - kappa j / 2 * sq w.
Hypothesis moves : forall j, sq (v j) <= rho2.
Definition g_kk : vec d := fun c => \big[Rplus/0]_(j in N) g j c.
Definition kappa_kk := \big[Rplus/0]_(j in N) kappa j.
(* The row of k for itself, and those of its neighbours j for k: g_jk = - g j. *)
Hypothesis own_row : - dot g_kk (v k) + kappa_kk * sq (v k) <= s (b k) / (share k + 1).
Hypothesis rows : forall j, j \in N -> dot (g j) (v j) + kappa j * sq (v j) <= s (b j) / (share j + 1).

Lemma dot_g_kk u : dot g_kk u = \big[Rplus/0]_(j in N) dot (g j) u.
Proof.
rewrite /dot exchange_big /=; apply: eq_bigr => c _; rewrite /g_kk Rmult_comm -sum_scale.
by apply: eq_bigr => j _; rewrite Rmult_comm.
Qed.

Lemma done_part j : sq (times (t j) (v j)) <= rho2.
Proof.
have := t01 j; have := sq_nonneg (v j); have := moves j; rewrite sq_times.
move: (sq _) (t j) => a u le a0 u01; have : u * u <= 1 by nra.
nra.
Qed.

(* thm:discrete 1 with (far') *)
Theorem far_prime_tick : h' >= h - s (pos h).
Proof.
pose e0 := - dot g_kk (times (t k) (v k)) + kappa_kk * sq (times (t k) (v k)).
pose e j := dot (g j) (times (t j) (v j)) + kappa j * sq (times (t j) (v j)).
have sh0 : 0 <= s (pos h) by apply: s_nonneg; exact: pos_nonneg.
have kk0 : 0 <= kappa_kk by apply: sum_nonneg.
have row j : j \in k |: N -> 0 <= s (b j) / (share j + 1).
  move=> jN; have [b0 _] := b_true jN; have := shares jN; have := pos_INR #|N| => n0 le.
  by apply: Rmult_le_pos; [exact: s_nonneg | apply/Rlt_le/Rinv_0_lt_compat; lra].
have total : e0 + \big[Rplus/0]_(j in N) e j <= s (pos h).
  apply: shares_fit => // [|j jN].
    apply: Rle_trans (share_le (setU11 k N)); rewrite /e0 dot_times_r sq_times.
    have q0 := sq_nonneg (v k); have := row_of_part (t01 k) (Rmult_le_pos _ _ kk0 q0) (row k (setU11 k N)) own_row.
    lra.
  have jN' : j \in k |: N by rewrite in_setU1 jN orbT.
  apply: Rle_trans (share_le jN'); rewrite /e dot_times_r sq_times.
  have q0 := sq_nonneg (v j).
  have := row_of_part (t01 j) (Rmult_le_pos _ _ (kappa0 j) q0) (row j jN') (rows jN).
  lra.
have links := @loss_of_links (fun j => - dot (g j) (times (t k) (v k)) + dot (g j) (times (t j) (v j)) +
  kappa j * sq (times (t k) (v k)) + kappa j * sq (times (t j) (v j))) _.
have {}links : h' >= h - (e0 + \big[Rplus/0]_(j in N) e j).
  have E : e0 + \big[Rplus/0]_(j in N) e j =
      \big[Rplus/0]_(j in N) (- dot (g j) (times (t k) (v k)) + dot (g j) (times (t j) (v j)) +
        kappa j * sq (times (t k) (v k)) + kappa j * sq (times (t j) (v j))).
    rewrite /e0 dot_g_kk /kappa_kk Rmult_comm -sum_scale.
    have -> : - (\big[Rplus/0]_(j in N) dot (g j) (times (t k) (v k))) =
              \big[Rplus/0]_(j in N) (-1 * dot (g j) (times (t k) (v k))) by rewrite sum_scale; lra.
    rewrite -!sum_add; apply: eq_bigr => j _; rewrite /e; lra.
  rewrite E; apply: links => j jN; rewrite /after /moved.
  have few : sq (minus (times (t k) (v k)) (times (t j) (v j))) <= 4 * rho2.
    have := sq_minus_le (times (t k) (v k)) (times (t j) (v j)); have := done_part k; have := done_part j; lra.
  have := bends jN few; rewrite dot_minus_r.
  have := sq_minus_le (times (t k) (v k)) (times (t j) (v j)); have := kappa0 j.
  move: (sq (minus _ _)) (sq (times (t k) _)) (sq (times (t j) _)) (kappa j) => z a c q q0 le; nra.
lra.
Qed.
End FarPrime.

(* (far): a weight falls by at most L per unit of squared distance. *)
Section FarPlain.
Variable L : V -> R.
Hypothesis L0 : forall j, 0 <= L j.
Hypothesis falls : forall j, j \in N ->
  weight j (after j) >= weight j (r j) - L j * pos (sq (after j) - sq (r j)).
(* The row of k for j, and that of j for k, with both sides times 4 L; b k and share k are those of k itself. *)
Hypothesis own_rows : forall j, j \in N ->
  4 * L j * (dot (r j) (v k) + sq (v k)) <= s (b k) / share k.
Hypothesis rows : forall j, j \in N ->
  4 * L j * (dot (times (-1) (r j)) (v j) + sq (v j)) <= s (b j) / share j.

(* thm:discrete 1 with (far) *)
Theorem far_tick : h' >= h - s (pos h).
Proof.
have sh0 : 0 <= s (pos h) by apply: s_nonneg; exact: pos_nonneg.
have [N0 | Npos] := posnP #|N|.
  have := @loss_of_links (fun=> 0) _; rewrite sum_const N0 Rmult_0_l => links.
  have noone j : j \in N -> False by move: N0 => /eqP; rewrite cards_eq0 => /eqP ->; rewrite inE.
  have {}links := links (fun j jN => False_ind _ (noone j jN)); lra.
have n1 : 1 <= INR #|N| by apply: (le_INR 1); apply/leP.
pose c := s (pos h) / INR #|N|.
have c0 : 0 <= c by apply: Rmult_le_pos => //; apply/Rlt_le/Rinv_0_lt_compat; lra.
have share_c j : j \in k |: N -> s (b j) / share j <= c.
  move=> jN; have [b0 bh] := b_true jN; have le := shares jN.
  apply: Rmult_le_compat; [exact: s_nonneg | by apply/Rlt_le/Rinv_0_lt_compat; lra | exact: s_mono |].
  by apply: Rinv_le_contravar; lra.
have each j : j \in N -> weight j (after j) >= weight j (r j) - c.
  move=> jN; have jN' : j \in k |: N by rewrite in_setU1 jN orbT.
  have := falls jN; set z := sq (after j) - sq (r j); set l := L j => fall.
  suff : l * pos z <= c by lra.
  have le_z : l * z <= c.
    rewrite /z /after sq_moved !dot_times_r.
    have := sq_minus_le (times (t k) (v k)) (times (t j) (v j)); rewrite !sq_times.
    have rk := Rle_trans _ _ _ (own_rows jN) (share_c k (setU11 k N)).
    have rj := Rle_trans _ _ _ (rows jN) (share_c j jN').
    have q k' := sq_nonneg (v k').
    have pk : t k * (4 * l * dot (r j) (v k)) + t k * t k * (4 * l * sq (v k)) <= c.
      by apply: row_of_part => //; [have := q k; have := L0 j; rewrite -/l; nra | move: rk; rewrite -/l; lra].
    have pj : t j * (4 * l * - dot (r j) (v j)) + t j * t j * (4 * l * sq (v j)) <= c.
      apply: row_of_part => //; first by have := q j; have := L0 j; rewrite -/l; nra.
      by move: rj; rewrite dot_times -/l; lra.
    have := L0 j; rewrite -/l; move: (sq (minus _ _)) (sq (v k)) (sq (v j)) (dot _ (v k)) (dot _ (v j)) pk pj.
    move=> w a a' p p' pk pj l0 lew.
    have : l * w <= l * (2 * (t k * t k * a) + 2 * (t j * t j * a')) by apply: Rmult_le_compat_l.
    nra.
  by rewrite /pos /Rmax; case: (Rle_dec z 0) => _; [rewrite Rmult_0_r | ].
have := loss_of_links each; rewrite sum_const.
have -> : INR #|N| * c = s (pos h) by rewrite /c; field; lra.
lra.
Qed.
End FarPlain.
End Far.
