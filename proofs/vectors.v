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
End Vectors.
