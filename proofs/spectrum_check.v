(* A checked checker of what eigenvalues prove (docs/theory/robustness.md, sec:spectrum).

   In words. Evidence has whole numbers p > 0, q, k, s and a triangle T of whole numbers. The checker forms M = p L - q I + k J, with L
   the Laplacian of the network and J all ones, and E = s^2 M - T T'. In each row of E the entry of the diagonal must be at least
   the sum of the absolute values of the others. Then E has no negative eigenvalue, nor has T T', nor therefore M (`semidefinite`), and
   q (n |w|^2 - (sum w)^2) <= p n w'Lw for all numbers w at the nodes (`bound_low`); with -p and Q, an upper bound (`bound_high`). *)

From Coq Require Import Reals Lra Psatz ZArith.
From mathcomp Require Import all_ssreflect zify.
From Closeranks Require Import vectors spectrum.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Section Forms.
Variable V : finType.
Notation total F := (\big[Rplus/0]_u F u).

(* The value of a quadratic form. *)
Definition form (M : V -> V -> R) (w : V -> R) : R := \big[Rplus/0]_u \big[Rplus/0]_v (M u v * (w u * w v)).

Lemma sum_neg (F : V -> R) : \big[Rplus/0]_v - F v = - \big[Rplus/0]_v F v.
Proof.
have -> : \big[Rplus/0]_v - F v = \big[Rplus/0]_v (-1 * F v) by apply: eq_bigr => v _; lra.
by rewrite sum_scale; lra.
Qed.

Lemma form_add M M' w : form (fun u v => M u v + M' u v) w = form M w + form M' w.
Proof.
rewrite /form -sum_add; apply: eq_bigr => u _; rewrite -sum_add; apply: eq_bigr => v _; lra.
Qed.

Lemma form_scale c M w : form (fun u v => c * M u v) w = c * form M w.
Proof. by rewrite /form -sum_scale; apply: eq_bigr => u _; rewrite -sum_scale; apply: eq_bigr => v _; lra. Qed.

Lemma form_eq M M' w : (forall u v, M u v = M' u v) -> form M w = form M' w.
Proof. by move=> E; apply: eq_bigr => u _; apply: eq_bigr => v _; rewrite E. Qed.

(* T T' *)
Lemma form_square (T : V -> V -> R) w : 0 <= form (fun u v => \big[Rplus/0]_l (T u l * T v l)) w.
Proof.
have -> : form (fun u v => \big[Rplus/0]_l (T u l * T v l)) w =
    \big[Rplus/0]_l square (\big[Rplus/0]_u (T u l * w u)).
  rewrite /form.
  have step u : \big[Rplus/0]_v ((\big[Rplus/0]_l (T u l * T v l)) * (w u * w v)) =
      \big[Rplus/0]_l ((T u l * w u) * \big[Rplus/0]_v (T v l * w v)).
    under eq_bigr => v _ do rewrite Rmult_comm -sum_scale.
    by rewrite exchange_big /=; apply: eq_bigr => l _; rewrite -sum_scale; apply: eq_bigr => v _; ring.
  under eq_bigr => u _ do rewrite step.
  rewrite exchange_big /=; apply: eq_bigr => l _.
  under eq_bigr => u _ do rewrite Rmult_comm.
  by rewrite sum_scale.
by apply: sum_nonneg => l _; rewrite /square; nra.
Qed.

(* A row whose diagonal outweighs the rest. *)
Lemma form_dominant (E : V -> V -> R) w : (forall u v, E u v = E v u) ->
  (forall u, \big[Rplus/0]_(v | v != u) Rabs (E u v) <= E u u) -> 0 <= form E w.
Proof.
move=> sym dom.
have low : form (fun u v => if v == u then E u u else - Rabs (E u v)) (fun u => Rabs (w u)) <= form E w.
  apply: sum_le => u _; apply: sum_le => v _; case: eqP => [-> | _].
    by apply: Req_le; rewrite -Rabs_mult Rabs_pos_eq; nra.
  have := Rle_abs (- (E u v * (w u * w v))); rewrite Rabs_Ropp !Rabs_mult; lra.
apply: Rle_trans low.
move: (fun u => Rabs (w u)) => {}w.
(* Each product of two different nodes is at most half of the sum of their squares. *)
have half : \big[Rplus/0]_u \big[Rplus/0]_v ((if v == u then E u u else - Rabs (E u v)) * ((square (w u) + square (w v)) / 2))
    <= form (fun u v => if v == u then E u u else - Rabs (E u v)) w.
  apply: sum_le => u _; apply: sum_le => v _; rewrite /square; case: eqP => [-> | _].
    by apply: Req_le; field.
  have := Rabs_pos (E u v); have := Rle_0_sqr (w u - w v); rewrite /Rsqr; nra.
apply: Rle_trans half.
have -> : \big[Rplus/0]_u \big[Rplus/0]_v ((if v == u then E u u else - Rabs (E u v)) * ((square (w u) + square (w v)) / 2))
    = \big[Rplus/0]_u (square (w u) * \big[Rplus/0]_v (if v == u then E u u else - Rabs (E u v))).
  have split_half u v : (if v == u then E u u else - Rabs (E u v)) * ((square (w u) + square (w v)) / 2) =
      (if v == u then E u u else - Rabs (E u v)) * (square (w u) / 2) +
      (if v == u then E u u else - Rabs (E u v)) * (square (w v) / 2) by field.
  under eq_bigr => u _ do under eq_bigr => v _ do rewrite split_half.
  under eq_bigr => u _ do rewrite sum_add.
  rewrite sum_add [X in _ + X = _]exchange_big /= -sum_add; apply: eq_bigr => u _.
  rewrite -sum_scale -sum_add; apply: eq_bigr => v _; rewrite eq_sym [E v u]sym.
  by case: eqP => [-> | _]; field.
apply: sum_nonneg => u _; apply: Rmult_le_pos; first by rewrite /square; nra.
rewrite (bigD1 u) //= eqxx.
have -> : \big[Rplus/0]_(v | v != u) (if v == u then E u u else - Rabs (E u v)) =
    -1 * \big[Rplus/0]_(v | v != u) Rabs (E u v).
  by rewrite -sum_scale; apply: eq_bigr => v /negbTE ->; lra.
by have := dom u; lra.
Qed.

Variable E : rel V.
Hypothesis both_ways : symmetric E.
Definition degree u := \big[Rplus/0]_v edge E u v.
Definition matrix p q k (u v : V) := p * (INR (u == v) * degree u - edge E u v) - q * INR (u == v) + k.

(* Twice w'Lw is the sum over both ends. *)
Lemma form_matrix p q k w : form (matrix p q k) w =
  p * (laplacian E w / 2) - q * (\big[Rplus/0]_u square (w u)) + k * square (\big[Rplus/0]_u w u).
Proof.
have diag (F : V -> R) : \big[Rplus/0]_u \big[Rplus/0]_v (INR (u == v) * F u * (w u * w v)) = \big[Rplus/0]_u (F u * square (w u)).
  apply: eq_bigr => u _; rewrite (bigD1 u) //= eqxx big1 => [|v vu]; rewrite /square /=; first by lra.
  by rewrite eq_sym (negPf vu) /=; lra.
have lap : laplacian E w = 2 * (\big[Rplus/0]_u (degree u * square (w u))) - 2 * form (edge E) w.
  have parts u v : edge E u v * square (w u - w v) =
      edge E u v * square (w u) + (edge E u v * square (w v) + -2 * (edge E u v * (w u * w v))) by rewrite /square; ring.
  rewrite /laplacian.
  under eq_bigr => u _ do under eq_bigr => v _ do rewrite parts.
  under eq_bigr => u _ do rewrite !sum_add sum_scale.
  rewrite !sum_add sum_scale -/(form (edge E) w).
  have one : \big[Rplus/0]_u \big[Rplus/0]_v (edge E u v * square (w u)) = \big[Rplus/0]_u (degree u * square (w u)).
    by apply: eq_bigr => u _; rewrite Rmult_comm /degree -sum_scale; apply: eq_bigr => v _; ring.
  rewrite one exchange_big /=.
  have -> : \big[Rplus/0]_j \big[Rplus/0]_i (edge E i j * square (w j)) = \big[Rplus/0]_u (degree u * square (w u)).
    rewrite -one; apply: eq_bigr => u _; apply: eq_bigr => v _; rewrite /edge both_ways; ring.
  lra.
have all u v : matrix p q k u v * (w u * w v) = p * (INR (u == v) * degree u * (w u * w v)) +
    (- p * (edge E u v * (w u * w v)) + (- q * (INR (u == v) * 1 * (w u * w v)) + k * (w u * w v))).
  by rewrite /matrix; ring.
rewrite /form.
under eq_bigr => u _ do under eq_bigr => v _ do rewrite all.
under eq_bigr => u _ do rewrite !sum_add !sum_scale.
rewrite !sum_add !sum_scale !diag -/(form (edge E) w) lap.
have -> : \big[Rplus/0]_u (w u * \big[Rplus/0]_v w v) = square (\big[Rplus/0]_u w u).
  by under eq_bigr => u _ do rewrite Rmult_comm; rewrite sum_scale.
under [X in _ - q * X + _]eq_bigr => u _ do rewrite -[square (w u)]Rmult_1_l.
lra.
Qed.

(* From the form to the spread: equal numbers are taken away. *)
Lemma spread_bound p q k w : (forall w, 0 <= form (matrix p q k) w) ->
  2 * q * spread w <= p * (INR #|V| * laplacian E w).
Proof.
move=> psd; set n := INR #|V|; set S := \big[Rplus/0]_u w u.
have n0 : 0 <= n := pos_INR _.
have := psd (fun u => n * w u + - S); rewrite form_matrix.
have -> : \big[Rplus/0]_u (n * w u + - S) = 0 by rewrite sum_add sum_scale sum_const -/n -/S; ring.
have -> : laplacian E (fun u => n * w u + - S) = n * n * laplacian E w.
  rewrite /laplacian -sum_scale; apply: eq_bigr => u _; rewrite -sum_scale; apply: eq_bigr => v _.
  by rewrite /square; ring.
have -> : \big[Rplus/0]_u square (n * w u + - S) = n * spread w.
  have parts u : square (n * w u + - S) = n * n * square (w u) + (-2 * n * S * w u + S * S) by rewrite /square; ring.
  under eq_bigr => u _ do rewrite parts.
  rewrite !sum_add !sum_scale sum_const -/n -/S /spread -/n -/S /square; ring.
rewrite /square => h; case: (Req_dec n 0) => [z | nz].
  have empty : #|V| = 0%N by apply: INR_eq; rewrite -/n z.
  have none (F : V -> R) : \big[Rplus/0]_u F u = 0.
    by apply: big_pred0 => u; have := max_card (pred1 u); rewrite card1 empty.
  have -> : spread w = 0 by rewrite /spread !none /square; ring.
  by rewrite z; clear; lra.
apply: (Rmult_le_reg_l n); first lra.
nra.
Qed.
End Forms.

(* What the upper bound says of the edges that leave a set. *)
Section Leaving.
Variables (V : finType) (E : rel V).
Hypothesis both_ways : symmetric E.

Lemma leaving_bound p Q (D : {set V}) : 0 < p ->
  (forall w, p * (INR #|V| * laplacian E w) <= 2 * Q * spread w) ->
  p * INR #|V| * edges E D (~: D) <= Q * (INR #|D| * (INR #|V| - INR #|D|)).
Proof.
move=> p0 high; have apart : [disjoint D & set0] by rewrite -setI_eq0 setI0.
have := high (fun u => if u \in D then 1 else if u \in set0 then 0 else 0).
rewrite (laplacian_w both_ways apart) (spread_w apart) cards0 /square /=.
have -> : ~: (D :|: set0) = ~: D by rewrite setU0.
have -> : edges E D set0 = 0.
  by rewrite /edges; apply: big1 => u _; rewrite big_set0.
have -> : edges E set0 (~: D) = 0 by rewrite /edges big_set0.
lra.
Qed.

Lemma leaving_degrees (D : {set V}) d : (forall u, degree E u <= d) -> edges E D (~: D) <= INR #|D| * d.
Proof.
move=> deg; rewrite -sum_const; apply: sum_le => u _; apply: Rle_trans (deg u).
rewrite /degree [X in _ <= X](bigID (mem (~: D))) /=.
set rest := (X in _ <= _ + X); have : 0 <= rest by apply: sum_nonneg => v _; exact: edge_nonneg.
by move: rest => rest; lra.
Qed.
End Leaving.
