(* The controller budget: whole runs (docs/theory/budget.md, thm:sensed).

   In words. Let no tick take more than s(h_k) from h_k as long as nobody counts on more than max(h_k, 0). Let everybody count on
   no more than what it sees. Then h_k >= 0 for ever if it is so at the start. One robot at a time: nothing is asked of the
   state of others.

   `tick` is what far_prime_tick and far_tick of budget.v give. What is seen is at most h_k by eq:known, which is `seen_low`
   here. *)

From Coq Require Import Reals Lra Psatz.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import vectors budget loss.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

(* eq:known: B are those whom i senses, k among them; the level of k is the sum over all robots that count. *)
Section Seen.
Variables (V : finType) (C B : {set V}) (a : V -> R).
Hypothesis nonneg : forall j, 0 <= a j.

Lemma split_level : \big[Rplus/0]_(j in C) a j =
  \big[Rplus/0]_(j in C :&: B) a j + \big[Rplus/0]_(j in C :\: B) a j.
Proof.
rewrite (bigID (fun j => j \in B)) /=; congr (_ + _); apply: eq_bigl => j; first by rewrite inE.
by rewrite inE andbC.
Qed.

Theorem seen_low : \big[Rplus/0]_(j in C :&: B) a j <= \big[Rplus/0]_(j in C) a j.
Proof. by rewrite split_level; have := sum_nonneg (fun j (_ : j \in C :\: B) => nonneg j); lra. Qed.
End Seen.

Section Run.
Variable gamma : R.
Hypothesis gamma01 : 0 < gamma <= 1.
Variable h : nat -> R.            (* h_k at ticks 0, 1, 2, ... *)
Variable used : nat -> R -> Prop. (* what neighbours of k count on at each tick *)
Hypothesis tick : forall p, (forall b, used p b -> b <= pos (h p)) ->
  h p.+1 >= h p - loss gamma (pos (h p)).
(* eq:known *)
Hypothesis known : forall p b, used p b -> b <= pos (h p).

(* thm:sensed *)
Theorem sensed : 0 <= h 0%N -> forall p, 0 <= h p.
Proof.
move=> h0; elim=> // p hp; have := tick (@known p); rewrite /pos Rmax_left; last lra.
by have := loss_range gamma01 hp; lra.
Qed.
End Run.
