(* One neighbour fewer is too few (docs/theory/agreement.md, sec:tight).

   In words. For all n and F with 2 F < n there is a network of n robots in which everybody hears at least F + floor(n/2) - 1
   others, nobody lies, and W-MSR(F), with whatever weights, never moves: two complete parts S and T of floor(n/2) and
   ceil(n/2) robots, each robot of S joined to F robots of T spread cyclically, value 1 on S and 0 on T. *)

From mathcomp Require Import all_ssreflect all_algebra zify.
From Closeranks Require Import round.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.Theory.

(* Who hears at most F smaller and at most F larger values never moves. *)
Lemma stuck_robot (V : finType) (R : realFieldType) F (b : R) i (x : V -> R) (N : {set V}) y :
  (#|under x N (x i)| <= F)%N -> (#|over x N (x i)| <= F)%N -> wmsr_step F b i x N y -> y = x i.
Proof.
move=> few_u few_o [K [w [tr [_ sum ->]]]].
have same j : j \in i |: K -> x j = x i.
  rewrite in_setU1 => /orP [/eqP -> // | jK].
  have jN : j \in N := subsetP (kept_heard tr) j jK.
  case: (ltgtP (x j) (x i)) => // lt.
    have [full _] := kept_below tr jK lt; have : (#|j |: below i x N K| <= F)%N.
      apply: leq_trans few_u; apply/subset_leq_card/subsetP => k; rewrite !inE => /orP [/eqP -> | ].
        by rewrite jN.
      by move=> /andP [/andP [_ ->] ->].
    by rewrite cardsU1 full !inE jK /= add1n ltnn.
  have [full _] := kept_above tr jK lt; have : (#|j |: above i x N K| <= F)%N.
    apply: leq_trans few_o; apply/subset_leq_card/subsetP => k; rewrite !inE => /orP [/eqP -> | ].
      by rewrite jN.
    by move=> /andP [/andP [_ ->] ->].
  by rewrite cardsU1 full !inE jK /= add1n ltnn.
rewrite (eq_bigr (fun j => w j * x i)%R); last by move=> j /same ->.
by rewrite -mulr_suml sum mul1r.
Qed.

Section Tight.
Variables (s t F : nat).      (* sizes of S and T *)
Hypothesis st : s <= t <= s.+1.
Hypothesis Ft : F <= t.
Hypothesis Fs : F <= s.
Definition robots := ('I_s + 'I_t)%type.

(* Robot a of S is joined to the robots a F, a F + 1, ..., a F + F - 1 of T, counted round and round. *)
Definition joined (a : 'I_s) (c : 'I_t) := [exists k : 'I_F, (a * F + k) %% t == c].

Definition hears (u : robots) : {set robots} :=
  [set v | match u, v with
           | inl a, inl a' => a' != a
           | inr c, inr c' => c' != c
           | inl a, inr c | inr c, inl a => joined a c
           end].

Lemma card_parts (P : {set robots}) :
  #|P| = #|[set a | inl a \in P]| + #|[set c | inr c \in P]|.
Proof.
by rewrite -!sum1_card big_sumType /=; congr (_ + _); apply: eq_bigl => x; rewrite inE.
Qed.

Lemma links_of_S (a : 'I_s) : #|[set c | joined a c]| = F.
Proof.
case: (posnP F) => [F0 | F0].
  rewrite F0; apply/eqP; rewrite cards_eq0; apply/eqP/setP => c; rewrite !inE.
  by apply/existsP => -[[k lt] _]; move: (lt); rewrite F0.
have t0 : 0 < t by apply: leq_trans Ft.
pose f (k : 'I_F) : 'I_t := Ordinal (ltn_pmod (a * F + k) t0).
have -> : [set c | joined a c] = f @: setT.
  apply/setP => c; rewrite inE; apply/existsP/imsetP => [[k /eqP E] | [k _ ->]].
    by exists k => //; apply: val_inj; rewrite /= E.
  by exists k.
rewrite card_imset ?cardsT ?card_ord // => k l /(congr1 val) /= /eqP.
rewrite eqn_modDl !modn_small ?(leq_trans (ltn_ord _)) // => /eqP; exact: val_inj.
Qed.

(* The robots of S that are joined to c are among the quotients (q t + c) / F. *)
Lemma links_of_T_most (c : 'I_t) : #|[set a | joined a c]| <= F.
Proof.
have [/set0Pn [a0 _] | /negPn /eqP ->] := boolP ([set a | joined a c] != set0); last by rewrite cards0.
have t0 : 0 < t by apply: leq_ltn_trans (ltn_ord c).
pose g (q : 'I_F) : 'I_s := insubd a0 ((q * t + c) %/ F).
apply: (@leq_trans #|g @: setT|); last by rewrite (leq_trans (leq_imset_card _ _)) // cardsT card_ord.
apply/subset_leq_card/subsetP => a; rewrite inE => /existsP [k /eqP E].
have F0 : 0 < F by apply: leq_ltn_trans (ltn_ord k).
have aF : a * F + k < F * t.
  apply: (@leq_trans (s * F)); last by rewrite mulnC leq_mul2l; case/andP: st => ->; rewrite orbT.
  apply: (@leq_trans (a.+1 * F)); last by rewrite leq_mul2r ltn_ord orbT.
  by rewrite mulSn addnC ltn_add2r.
have qF : (a * F + k) %/ t < F by rewrite ltn_divLR.
apply/imsetP; exists (Ordinal qF) => //; apply: val_inj.
by rewrite /g val_insubd /= -E -divn_eq divnMDl // divn_small // addn0 ltn_ord.
Qed.

Lemma links_of_T_least (c : 'I_t) : F - (t - s) <= #|[set a | joined a c]|.
Proof.
case: (posnP (F - (t - s))) => [-> // | pos].
have F0 : 0 < F by apply: leq_trans pos (leq_subr _ _).
have t0 : 0 < t by apply: leq_ltn_trans (ltn_ord c).
case/andP: st => le_st le_ts.
have small (q : 'I_(F - (t - s))) : (q * t + c) %/ F < s.
  rewrite ltn_divLR //; apply: (@leq_trans (q.+1 * t)); first by rewrite mulSn addnC ltn_add2r.
  apply: (@leq_trans ((F - (t - s)) * t)); first by rewrite leq_mul2r ltn_ord orbT.
  have [E | E] : t = s \/ t = s.+1 by lia.
    by rewrite E subnn subn0 mulnC.
  rewrite E subSn // subnn mulnBl mul1n mulnS [s * F]mulnC; lia.
pose g q : 'I_s := Ordinal (small q).
have -> : F - (t - s) = #|g @: setT|.
  rewrite card_imset ?cardsT ?card_ord // => k l /(congr1 val) /= E; apply: val_inj; move: E.
  wlog lt : k l / k < l => [gen | E].
    by case: (ltngtP k l) => // lt E; [exact: gen | apply/esym; exact: gen].
  exfalso; move: E; apply/eqP; rewrite neq_ltn; apply/orP; left.
  apply: (@leq_trans ((k * t + c + F) %/ F)).
    by rewrite (divnDr _ (dvdnn F)) divnn F0 addn1.
  by apply: leq_div2r; have := leq_mul2r t k.+1 l; rewrite lt orbT mulSn => le; lia.
apply/subset_leq_card/subsetP => a /imsetP [q _ ->]; rewrite inE; apply/existsP.
exists (Ordinal (ltn_pmod (q * t + c) F0)); rewrite /= -divn_eq modnMDl modn_small //.
Qed.

Lemma hears_many u : s.-1 + F <= #|hears u|.
Proof.
case: u => [a|c]; rewrite card_parts.
  have -> : #|[set a' | inl a' \in hears (inl a)]| = s.-1.
    have -> : [set a' | inl a' \in hears (inl a)] = [set~ a] by apply/setP => a'; rewrite !inE.
    by rewrite cardsC1 card_ord.
  have -> // : #|[set c | inr c \in hears (inl a)]| = F.
  by rewrite -[RHS](links_of_S a); apply: eq_card => c; rewrite !inE.
have -> : #|[set c' | inr c' \in hears (inr c)]| = t.-1.
  have -> : [set c' | inr c' \in hears (inr c)] = [set~ c] by apply/setP => c'; rewrite !inE.
  by rewrite cardsC1 card_ord.
have -> : #|[set a | inl a \in hears (inr c)]| = #|[set a | joined a c]|.
  by apply: eq_card => a; rewrite !inE.
have := links_of_T_least c; have := ltn_ord c; case/andP: st; lia.
Qed.

Variable R : realFieldType.
Definition value (u : robots) : R := if u is inl _ then 1%R else 0%R.

Lemma never_moves b u y : wmsr_step F b u value (hears u) y -> y = value u.
Proof.
apply: stuck_robot; rewrite card_parts; case: u => [a|c].
- apply: (@leq_trans (0 + F)) => //; apply: leq_add.
    rewrite leqn0 cards_eq0; apply/eqP/setP => a'; by rewrite !inE /= ltxx andbF.
  rewrite -[X in _ <= X](links_of_S a); apply/subset_leq_card/subsetP => c; by rewrite !inE => /andP [].
- apply: (@leq_trans (0 + 0)) => //; apply: leq_add; rewrite leqn0 cards_eq0; apply/eqP/setP => v.
    by rewrite !inE /= ltNge ler01 andbF.
  by rewrite !inE /= ltxx andbF.
- apply: (@leq_trans (0 + 0)) => //; apply: leq_add; rewrite leqn0 cards_eq0; apply/eqP/setP => v.
    by rewrite !inE /= ltxx andbF.
  by rewrite !inE /= ltNge ler01 andbF.
- apply: (@leq_trans (F + 0)); last by rewrite addn0.
  apply: leq_add; last by rewrite leqn0 cards_eq0; apply/eqP/setP => c'; rewrite !inE /= ltxx andbF.
  apply: leq_trans (links_of_T_most c); apply/subset_leq_card/subsetP => a; by rewrite !inE => /andP [].
Qed.
End Tight.

(* sec:tight *)
Theorem one_fewer_is_too_few n F (R : realFieldType) : F.*2 < n ->
  exists (V : finType) (N : V -> {set V}) (x : V -> R),
  [/\ #|V| = n, forall u, u \notin N u, forall u, F + n./2 - 1 <= #|N u|,
      (exists u v, x u <> x v) \/ n = 1 &
      forall u b y, wmsr_step F b u x (N u) y -> y = x u].
Proof.
move=> Fn; pose s := n./2; pose t := n - n./2.
have st : s <= t <= s.+1 by rewrite /s /t; lia.
have Ft : F <= t by rewrite /t; lia.
have Fs : F <= s by rewrite /s; lia.
exists [finType of robots s t], (@hears s t F), (@value s t R); split.
- by rewrite card_sum !card_ord /s /t; lia.
- by case=> u; rewrite inE eqxx.
- move=> u; have := hears_many st Ft Fs u; apply: leq_trans; rewrite /s; lia.
- have [s0 | s0] := posnP s; [right; rewrite /s in s0; lia | left].
  have t0 : 0 < t by case/andP: st => h _; apply: leq_trans h.
  by exists (inl (Ordinal s0)), (inr (Ordinal t0)) => /eqP; rewrite oner_eq0.
- move=> u b y; exact: never_moves.
Qed.
