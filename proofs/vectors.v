(* Sums and vectors over the reals, as far as the rows need them. Nothing here is about robots. *)

From Coq Require Import Reals Lra Psatz.
From mathcomp Require Import all_ssreflect.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

Lemma RaddA : associative Rplus. Proof. by move=> x y z; rewrite Rplus_assoc. Qed.
Lemma RaddC : commutative Rplus. Proof. exact: Rplus_comm. Qed.
Lemma Radd0 : left_id 0 Rplus. Proof. exact: Rplus_0_l. Qed.
Lemma Radd0r : right_id 0 Rplus. Proof. exact: Rplus_0_r. Qed.
Canonical Radd_monoid := Monoid.Law RaddA Radd0 Radd0r.
Canonical Radd_comoid := Monoid.ComLaw RaddC.

Notation "'sum' ( i | P ) e" := (\big[Rplus/0]_(i | P) e) (at level 41, i at level 99, e at level 41).
Notation "'sum' ( i 'in' A ) e" := (\big[Rplus/0]_(i in A) e) (at level 41, i at level 99, e at level 41).

Section Sums.
Variables (I : finType).
Implicit Types (P : pred I) (f g : I -> R).

Lemma sum_le P f g : (forall i, P i -> f i <= g i) -> \big[Rplus/0]_(i | P i) f i <= \big[Rplus/0]_(i | P i) g i.
Proof. by move=> le; apply: (big_ind2 Rle) => // [|x y u v h k]; [lra | lra]. Qed.

Lemma sum_add P f g :
  \big[Rplus/0]_(i | P i) (f i + g i) = \big[Rplus/0]_(i | P i) f i + \big[Rplus/0]_(i | P i) g i.
Proof. exact: big_split. Qed.

Lemma sum_scale P a f : \big[Rplus/0]_(i | P i) (a * f i) = a * \big[Rplus/0]_(i | P i) f i.
Proof.
by apply: (big_rec2 (fun x y => x = a * y)) => [|i x y _ ->]; [rewrite Rmult_0_r | rewrite Rmult_plus_distr_l].
Qed.

Lemma sum_const P a : \big[Rplus/0]_(i | P i) a = INR #|[pred i | P i]| * a.
Proof.
rewrite big_const -[X in iter X]/(#|[pred i | P i]|); elim: #|_| => [|n IH] /=; first by rewrite Rmult_0_l.
by rewrite IH -/(INR n.+1) S_INR; lra.
Qed.

Lemma sum_nonneg P f : (forall i, P i -> 0 <= f i) -> 0 <= \big[Rplus/0]_(i | P i) f i.
Proof. by move=> pos; apply: (big_ind (fun x => 0 <= x)) => //; [lra | move=> x y; lra]. Qed.
End Sums.

Section Vectors.
Variable d : nat.                       (* dimension *)
Definition vec := 'I_d -> R.
Definition dot (u v : vec) : R := \big[Rplus/0]_(c : 'I_d) (u c * v c).
Definition plus (u v : vec) : vec := fun c => u c + v c.
Definition minus (u v : vec) : vec := fun c => u c - v c.
Definition times (t : R) (u : vec) : vec := fun c => t * u c.
Definition sq (u : vec) : R := dot u u.   (* squared length *)

Lemma dotC u v : dot u v = dot v u.
Proof. by apply: eq_bigr => c _; rewrite Rmult_comm. Qed.
Lemma dot_plus u v w : dot (plus u v) w = dot u w + dot v w.
Proof. by rewrite /dot -big_split; apply: eq_bigr => c _; rewrite /plus Rmult_plus_distr_r. Qed.
Lemma dot_times t u v : dot (times t u) v = t * dot u v.
Proof. by rewrite /dot -sum_scale; apply: eq_bigr => c _; rewrite /times Rmult_assoc. Qed.
Lemma dot_minus u v w : dot (minus u v) w = dot u w - dot v w.
Proof.
have E : minus u v =1 plus u (times (-1) v) by move=> c; rewrite /minus /plus /times; lra.
have -> : dot (minus u v) w = dot (plus u (times (-1) v)) w by apply: eq_bigr => c _; rewrite E.
by rewrite dot_plus dot_times; lra.
Qed.
Lemma dot_plus_r u v w : dot w (plus u v) = dot w u + dot w v.
Proof. by rewrite dotC dot_plus !(dotC w). Qed.
Lemma dot_minus_r u v w : dot w (minus u v) = dot w u - dot w v.
Proof. by rewrite dotC dot_minus !(dotC w). Qed.
Lemma dot_times_r t u v : dot v (times t u) = t * dot v u.
Proof. by rewrite dotC dot_times !(dotC v). Qed.
Lemma sq_nonneg u : 0 <= sq u.
Proof. by apply: sum_nonneg => c _; nra. Qed.
Lemma sq_minus u v : sq (minus u v) = sq u - 2 * dot u v + sq v.
Proof. by rewrite /sq dot_minus !dot_minus_r (dotC v u); lra. Qed.
Lemma sq_plus u v : sq (plus u v) = sq u + 2 * dot u v + sq v.
Proof. by rewrite /sq dot_plus !dot_plus_r (dotC v u); lra. Qed.
Lemma sq_times t u : sq (times t u) = t * t * sq u.
Proof. by rewrite /sq dot_times dot_times_r; lra. Qed.
Lemma dot_ext u u' v v' : u =1 u' -> v =1 v' -> dot u v = dot u' v'.
Proof. by move=> Eu Ev; apply: eq_bigr => c _; rewrite Eu Ev. Qed.

(* |u - v|^2 <= 2 |u|^2 + 2 |v|^2 *)
Lemma sq_minus_le u v : sq (minus u v) <= 2 * sq u + 2 * sq v.
Proof. by have := sq_nonneg (plus u v); rewrite sq_minus sq_plus; lra. Qed.

(* The offset of two robots at offset r after moves v and w. *)
Definition moved (r v w : vec) : vec := plus r (minus v w).
Lemma sq_moved r v w :
  sq (moved r v w) = sq r + 2 * dot r v - 2 * dot r w + sq (minus v w).
Proof. by rewrite /moved sq_plus dot_minus_r; lra. Qed.
Lemma cauchy_schwarz u w : dot u w * dot u w <= sq u * sq w.
Proof.
have u0 := sq_nonneg u; have w0 := sq_nonneg w.
have all t : 0 <= sq u - 2 * t * dot u w + t * t * sq w.
  have := sq_nonneg (minus u (times t w)); rewrite sq_minus dot_times_r sq_times; lra.
case: (Rle_lt_dec (sq w) 0) => [w00 | pos].
  have wz : sq w = 0 by lra.
  case: (Req_dec (dot u w) 0) => [-> | ne]; first by rewrite wz; lra.
  have := all ((sq u + 1) / (2 * dot u w)); rewrite wz.
  have -> : 2 * ((sq u + 1) / (2 * dot u w)) * dot u w = sq u + 1 by field.
  lra.
have := all (dot u w / sq w).
have -> : sq u - 2 * (dot u w / sq w) * dot u w + dot u w / sq w * (dot u w / sq w) * sq w =
          (sq u * sq w - dot u w * dot u w) / sq w by field; lra.
move=> h; have : 0 <= (sq u * sq w - dot u w * dot u w) / sq w * sq w by apply: Rmult_le_pos; lra.
have -> : (sq u * sq w - dot u w * dot u w) / sq w * sq w = sq u * sq w - dot u w * dot u w by field; lra.
lra.
Qed.

(* Who is farther away than R and can come nearer by at most 2 rho stays farther away than Dd. *)
Lemma far_apart (r e : vec) R' rho Dd : 0 <= rho -> 0 <= Dd -> Dd <= R' - 2 * rho ->
  R' * R' < sq r -> sq e <= 4 * (rho * rho) -> Dd * Dd <= sq (plus r e).
Proof.
move=> rho0 Dd0 room far few; apply: Rle_trans (_ : (R' - 2 * rho) * (R' - 2 * rho) <= _); first nra.
have e0 := sq_nonneg e; case: (Req_dec rho 0) => [z | rn].
  have cs := cauchy_schwarz r e; rewrite z in few *; have ez : sq e = 0 by lra.
  rewrite ez in cs; have dz : dot r e = 0 by nra.
  by rewrite sq_plus dz ez; lra.
have := sq_nonneg (plus (times (2 * rho) r) (times R' e)).
rewrite sq_plus !sq_times dot_times dot_times_r => mix; rewrite sq_plus.
apply: (Rmult_le_reg_l (2 * rho * R')); first nra.
move: (sq r) (sq e) (dot r e) far few e0 mix => X Y p far few e0 mix.
have h1 : 0 <= 2 * rho * (R' - 2 * rho) * (X - R' * R') by apply: Rmult_le_pos; [nra | lra].
have h2 : 0 <= R' * (R' - 2 * rho) * (4 * (rho * rho) - Y) by apply: Rmult_le_pos; [nra | lra].
lra.
Qed.
End Vectors.
