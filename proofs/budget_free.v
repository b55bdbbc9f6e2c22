(* The controller budget with malicious robots that move as they like (docs/theory/budget.md, thm:free).

   In words. T_k is the sum of the weights of k without its F largest, theta = F + floor((n - F)/2), T_k >= theta at the start.
   Normal robots move by (far) with h = T - theta. Then whatever the a <= F malicious robots A do or say, every
   normal robot k keeps at least theta + F - a normal neighbours, which is enough for thm:two-faced.

   The proof follows, for each set A' of F robots that contains A, the sum S(A') of the weights to robots outside of A'. It is
   at least T_k, and it loses no more than its share in a tick (`tick`, which is far_tick of budget.v with the robots outside of
   A' as those that count). So S(A') stays at theta or more for each A'. *)

From Coq Require Import Reals Lra Psatz.
From mathcomp Require Import all_ssreflect zify.
From Closeranks Require Import vectors budget loss budget_run weights.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Local Open Scope R_scope.

(* m members of Y, of X first. *)
Lemma choose (V : finType) (X Y : {set V}) m : X \subset Y -> (m <= #|Y|)%N ->
  exists B : {set V}, [/\ B \subset Y, #|B| = m & B \subset X \/ X \subset B].
Proof.
move=> XY mY; pose s := enum X ++ enum (Y :\: X).
have us : uniq s.
  rewrite cat_uniq !enum_uniq andbT /=; apply/hasPn => j; rewrite mem_enum inE => /andP [jX _].
  by change (j \notin enum X); rewrite mem_enum.
have ss : size s = #|Y| by rewrite size_cat -!cardE -(cardsID X Y) (setIidPr XY).
have ms : (m <= size s)%N by rewrite ss.
exists [set j in take m s]; split.
- apply/subsetP => j; rewrite inE => /mem_take; rewrite mem_cat !mem_enum => /orP [/(subsetP XY) // | ].
  by rewrite inE => /andP [].
- by rewrite cardsE -[RHS](size_takel ms); apply/card_uniqP; exact: take_uniq.
- case: (leqP m (size (enum X))) => le; [left | right]; apply/subsetP => j.
    by rewrite inE /s takel_cat // => /mem_take; rewrite mem_enum.
  by move=> jX; rewrite inE /s take_cat ltnNge (ltnW le) /= mem_cat mem_enum jX.
Qed.

Section Free.
Variable gamma : R.
Hypothesis gamma01 : 0 < gamma <= 1.
Variables (V : finType) (k : V) (A : {set V}) (F th : nat).
Hypothesis kA : k \notin A.
Hypothesis few : (#|A| <= F)%N.
Hypothesis Fn : (F < #|V|)%N.
Hypothesis th0 : (0 < th)%N.
Variable a : nat -> V -> R.       (* weights of the links of k at ticks 0, 1, 2, ... *)
Hypothesis nonneg : forall p j, 0 <= a p j.
Variable eps : R.
Hypothesis eps0 : 0 <= eps.
Hypothesis eps_small : (INR th - 1) * eps < 2.
Hypothesis height : forall p j, a p j <= 1 + eps / 2.

Definition S p (A' : {set V}) := \big[Rplus/0]_(j in ~: (k |: A')) a p j.
Definition liars_among (A' : {set V}) := [/\ A \subset A', k \notin A' & #|A'| = F].

Variable T : nat -> R.            (* the trimmed sum *)
Hypothesis trimmed : forall p (A' : {set V}), k \notin A' -> #|A'| = F -> T p <= S p A'.
Hypothesis start : INR th <= T 0%N.

(* What k and its normal neighbours count on: seen, which is at most T - theta. *)
Variable used : nat -> R -> Prop.
Hypothesis known : forall p b, used p b ->
  b <= pos (T p - INR th).
Hypothesis tick : forall p (A' : {set V}), liars_among A' -> (forall b, used p b -> b <= pos (S p A' - INR th)) ->
  S p.+1 A' - INR th >= S p A' - INR th - loss gamma (pos (S p A' - INR th)).

Lemma pos_mono u v : u <= v -> pos u <= pos v.
Proof. by move=> le; apply: Rle_max_compat_r. Qed.

Theorem sums_stay (A' : {set V}) : liars_among A' -> forall p, INR th <= S p A'.
Proof.
move=> among; have [sub kA' cardA'] := among.
have low p : pos (T p - INR th) <= pos (S p A' - INR th).
  by apply: pos_mono; have := trimmed p kA' cardA'; lra.
have h0 : 0 <= S 0 A' - INR th by have := trimmed 0 kA' cardA'; lra.
move=> p; suff : 0 <= S p A' - INR th by lra.
apply: (sensed gamma01 (h := fun p => S p A' - INR th) (used := used)) => // [p' ok|p' b us].
  exact: tick.
exact: Rle_trans (known us) (low p').
Qed.

Definition normal_neighbours p := [set j | (j \notin A) && (j != k) & (Rlt_dec 0 (a p j) : bool)].

(* thm:free *)
Theorem free p : (th + (F - #|A|) <= #|normal_neighbours p|)%N.
Proof.
rewrite leqNgt; apply/negP => less; set N := normal_neighbours p in less *.
have NY : N \subset ~: (k |: A).
  by apply/subsetP => j; rewrite !inE negb_or => /andP [/andP [-> ->]].
have room : (F - #|A| <= #|~: (k |: A)|)%N.
  by have := cardsC (k |: A); rewrite cardsU1 kA; move: few Fn; lia.
have [B [BY cardB side]] := choose NY room.
have BA : [disjoint A & B].
  rewrite -setI_eq0; apply/eqP/setP => j; rewrite !inE; apply/andP => -[jA jB].
  by have := subsetP BY j jB; rewrite !inE jA orbT.
have among : liars_among (A :|: B).
  split; first exact: subsetUl.
    by rewrite inE negb_or kA; apply/negP => /(subsetP BY); rewrite !inE eqxx.
  by have := leq_card_setU A B; rewrite cardsU; move: BA; rewrite -setI_eq0 => /eqP ->; rewrite cards0 cardB; move: few; lia.
have many := sums_stay among p.
have : (th <= #|N :\: B|)%N.
  apply: (degree_counts (a := a p) (eps := eps)) => //.
  have -> : \big[Rplus/0]_(j in N :\: B) a p j = S p (A :|: B); last by lra.
  rewrite /S [RHS](bigID (fun j => j \in N)) /= [X in _ = _ + X]big1 ?Rplus_0_r.
    apply: eq_bigl => j; rewrite !inE; case: (j \in B); rewrite ?orbT ?andbF //= orbF.
    by case: (j == k); case: (j \in A); rewrite ?andbF ?andbT.
  move=> j /andP []; rewrite !inE !negb_or => /andP [jk /andP [jA jB]]; rewrite jA jk /=.
  case: (Rlt_dec 0 (a p j)) => // h _; have := nonneg p j; lra.
move: side => [BN | NB].
  by have := cardsID B N; rewrite (setIidPr BN) cardB; move: less; lia.
have -> : N :\: B = set0 by apply/eqP; rewrite setD_eq0.
by rewrite cards0; move: th0; lia.
Qed.
End Free.

(* theta + F - a normal neighbours are what thm:two-faced asks for. *)
Lemma free_is_enough n F a : (a <= F)%N -> (F <= n)%N ->
  (F + (n - a)./2 <= F + (n - F)./2 + (F - a))%N.
Proof. lia. Qed.
