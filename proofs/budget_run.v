(* The controller budget: whole runs (docs/theory/budget.md, thm:any-claim, sec:age).

   In words. Let no tick take more than s(h_k) from h_k as long as nobody counts on more than max(h_k, 0). Let everybody count on
   no more than what it sees, or on what is left, after m ticks, of a true level that was told m ticks ago. Then h_k >= 0 for
   ever if it is so at the start. Whatever is lost, late, doubled or reordered only changes which m. One robot at a time:
   nothing is asked of the state of others.

   `tick` is what far_prime_tick and far_tick of budget.v give. `seen` is at most h_k by eq:interval, which is
   `interval_low` and `interval_high` here. *)

From Coq Require Import Reals Lra Psatz.
From mathcomp Require Import all_ssreflect.
From Closeranks Require Import vectors budget loss.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

(* eq:interval: B are those whom i senses, k among them; the level of k is the sum over all robots that count. *)
Section Interval.
Variables (V : finType) (C B : {set V}) (a : V -> R) (edge : R).
Hypothesis nonneg : forall j, 0 <= a j.
Hypothesis unseen : forall j, j \in C -> j \notin B -> a j <= edge.

Lemma split_level : \big[Rplus/0]_(j in C) a j =
  \big[Rplus/0]_(j in C :&: B) a j + \big[Rplus/0]_(j in C :\: B) a j.
Proof.
rewrite (bigID (fun j => j \in B)) /=; congr (_ + _); apply: eq_bigl => j; first by rewrite inE.
by rewrite inE andbC.
Qed.

Theorem interval_low : \big[Rplus/0]_(j in C :&: B) a j <= \big[Rplus/0]_(j in C) a j.
Proof. by rewrite split_level; have := sum_nonneg (fun j (_ : j \in C :\: B) => nonneg j); lra. Qed.

Theorem interval_high :
  \big[Rplus/0]_(j in C) a j <= \big[Rplus/0]_(j in C :&: B) a j + INR #|C :\: B| * edge.
Proof.
rewrite split_level; have : \big[Rplus/0]_(j in C :\: B) a j <= INR #|C :\: B| * edge; last by lra.
by rewrite -sum_const; apply: sum_le => j /setDP [jC jB]; exact: unseen.
Qed.
End Interval.

Section Run.
Variables gamma q : R.
Hypothesis gamma01 : 0 < gamma <= 1.
Hypothesis q0 : 0 <= q.
Variable h : nat -> R.            (* h_k at ticks 0, 1, 2, ... *)
Variable used : nat -> R -> Prop. (* what neighbours of k count on at each tick *)
Hypothesis tick : forall p, (forall b, used p b -> b <= pos (h p)) ->
  h p.+1 >= h p - loss gamma q (pos (h p)).
(* eq:known: seen, or told m ticks ago and discounted, or nothing. *)
Hypothesis known : forall p b, used p b ->
  b <= pos (h p) \/ exists2 m, (m <= p)%N & b <= decayed gamma q m (pos (h (p - m)%N)).

Lemma one_tick p : 0 <= h p -> (forall b, used p b -> b <= pos (h p)) ->
  0 <= h p.+1 /\ part q (1 - gamma) (h p) <= h p.+1.
Proof.
move=> hp ok; have := tick ok; rewrite /pos Rmax_left; last lra.
have := loss_range gamma01 q0 hp; have := loss_is_part gamma01 q0 hp; lra.
Qed.

Lemma all_so_far : 0 <= h 0%N -> forall p, (forall k, (k <= p)%N -> 0 <= h k) /\
  forall m, (m <= p)%N -> decayed gamma q m (h (p - m)%N) <= h p.
Proof.
move=> h0; elim=> [|p [old left_p]].
  by split=> [k|m]; rewrite leqn0 => /eqP -> //; rewrite subn0 decayed_0 //; exact: Rle_refl.
have hp := old p (leqnn p).
have ok b : used p b -> b <= pos (h p).
  case/known => // -[m mp le]; apply: Rle_trans le _.
  have hm : 0 <= h (p - m)%N by apply: old; exact: leq_subr.
  by rewrite /pos !Rmax_left; [exact: left_p | lra | lra].
have [hp1 kept] := one_tick hp ok; split=> [k | [|m] mp].
- by rewrite leq_eqVlt => /orP [/eqP -> // | ]; rewrite ltnS; exact: old.
- by rewrite subn0 decayed_0 //; exact: Rle_refl.
rewrite subSS decayed_S //; last by apply: old; exact: leq_subr.
apply: Rle_trans kept; apply: part_mono => //; first lra; last exact: left_p.
by apply: decayed_nonneg => //; apply: old; exact: leq_subr.
Qed.

(* eq:decayed: losing at most s(h) in each of m ticks leaves at least left(h, m). *)
Theorem left_after : 0 <= h 0%N -> forall p m, (m <= p)%N -> decayed gamma q m (h (p - m)%N) <= h p.
Proof. by move=> h0 p; have [_] := all_so_far h0 p. Qed.

(* thm:any-claim *)
Theorem any_claim : 0 <= h 0%N -> forall p, 0 <= h p.
Proof. by move=> h0 p; have [old _] := all_so_far h0 p; exact: old. Qed.
End Run.
