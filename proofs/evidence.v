(* A checked checker of evidence (docs/theory/robustness.md, sec:bounds; docs/theory/agreement.md, thm:ranks).

   In words. Evidence is a network, as the list of whom each node hears, and a claim with what proves it. Each of three programs looks
   at every edge a few times, and what passes is true:
   `refutes_sound`: two lists of nodes that pass `refutes_check` prove that the network is not (r,s)-robust;
   `degrees_sound`: a network that passes `degrees_check` is (r,s)-robust for every s;
   `order_sound`: a core and an order of all other nodes that pass `order_check` give ranks that meet what thm:ranks asks of a
   network, so that `order_agrees` holds: W-MSR agrees whatever up to F malicious robots around each normal robot tell.

   The programs are extracted to OCaml (evidence_model.v), and check.sh gives them and the Rust checker the same evidence. *)

From mathcomp Require Import all_ssreflect all_algebra zify.
From Closeranks Require Import robust round agreement ranks.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

(* On lists of numbers; arithmetic as extraction knows it. *)
Definition member v (s : seq nat) := has (Nat.eqb v) s.
Fixpoint distinct (s : seq nat) := if s is v :: t then ~~ member v t && distinct t else true.
Definition network := seq (seq nat).
Definition heard (g : network) v := nth [::] g v.
Definition inside (g : network) s := all (fun v => Nat.ltb v (size g)) s.
Definition network_ok (g : network) :=
  all (fun v => [&& distinct (heard g v), inside g (heard g v) & ~~ member v (heard g v)]) (iota 0 (size g)).

(* How many nodes outside of S node v hears. *)
Definition outside g S v := count (fun u => ~~ member u S) (heard g v).
Definition refutes_check g r s S1 S2 :=
  [&& network_ok g, distinct (S1 ++ S2), inside g (S1 ++ S2), ~~ nilp S1, ~~ nilp S2,
      has (fun v => Nat.ltb (outside g S1 v) r) S1, has (fun v => Nat.ltb (outside g S2 v) r) S2 &
      Nat.ltb (count (fun v => Nat.leb r (outside g S1 v)) S1 + count (fun v => Nat.leb r (outside g S2 v)) S2) s].

Definition degrees_check g r :=
  [&& network_ok g, Nat.ltb 0 r & all (fun h => Nat.leb (Nat.div2 (size g) + Nat.pred r) (size h)) g].

Fixpoint walk g F before rest := if rest is v :: t
  then Nat.leb (2 * F + 1) (count (fun u => member u before) (heard g v)) && walk g F (v :: before) t else true.
Definition order_check g F core rest :=
  [&& network_ok g, distinct (core ++ rest), inside g (core ++ rest), Nat.eqb (size core + size rest) (size g),
      Nat.leb (2 * F + 1) (size core),
      all (fun v => Nat.leb (F + Nat.div2 (size core)) (count (fun u => member u core) (heard g v))) core &
      walk g F core rest].

(* What the arithmetic means. *)
Lemma eqbE m n : Nat.eqb m n = (m == n). Proof. by apply/idP/eqP => /PeanoNat.Nat.eqb_eq. Qed.
Lemma lebE m n : Nat.leb m n = (m <= n). Proof. by apply/idP/leP => /PeanoNat.Nat.leb_le. Qed.
Lemma ltbE m n : Nat.ltb m n = (m < n). Proof. exact: lebE. Qed.
Lemma div2E n : Nat.div2 n = n./2.
Proof. by have [m] := ubnP n; elim: m n => // m IH [|[|n]] //= le; rewrite IH //; lia. Qed.
Lemma memberE v s : member v s = (v \in s).
Proof. by rewrite /member -has_pred1; apply: eq_has => u; rewrite eqbE /= eq_sym. Qed.
Lemma distinctE s : distinct s = uniq s.
Proof. by elim: s => //= v t ->; rewrite memberE. Qed.
Lemma insideP g s : reflect (forall v, v \in s -> v < size g) (inside g s).
Proof. by apply: (iffP allP) => all v /all; rewrite ltbE. Qed.

Section Network.
Variable g : network.
Hypothesis ok : network_ok g.
Let n := size g.
Definition N (v : 'I_n) : {set 'I_n} := [set u : 'I_n | (u : nat) \in heard g v].
Definition nodes (s : seq nat) : {set 'I_n} := [set u : 'I_n | (u : nat) \in s].

Lemma row (v : 'I_n) : [/\ uniq (heard g v), inside g (heard g v) & (v : nat) \notin heard g v].
Proof.
have := allP ok v; rewrite mem_iota /= => /(_ (ltn_ord v)) /and3P [].
by rewrite distinctE memberE.
Qed.

(* A list of distinct nodes has as many as the set. *)
Lemma card_nodes s : uniq s -> inside g s -> #|nodes s| = size s.
Proof.
move=> us /insideP ins.
have -> : nodes s = [set u in pmap insub s] by apply/setP => u; rewrite !inE mem_pmap_sub.
rewrite cardsE; have up : uniq (pmap (insub : nat -> option 'I_n) s) by exact: pmap_sub_uniq.
rewrite (card_uniqP up) size_pmap_sub; apply/eqP; rewrite -all_count; apply/allP => v vs; exact: ins.
Qed.

Lemma card_count (v : 'I_n) (P : pred nat) : #|[set u in N v | P u]| = count P (heard g v).
Proof.
have [us ins _] := row v; rewrite -size_filter -card_nodes ?filter_uniq //; last first.
  by apply/insideP => u; rewrite mem_filter => /andP [_]; exact: (insideP _ _ ins).
by congr #|pred_of_set _|; apply/setP => u; rewrite !inE mem_filter andbC.
Qed.

Lemma outsideE S (v : 'I_n) : outside g S v = #|N v :\: nodes S|.
Proof.
rewrite /outside -card_count; congr #|pred_of_set _|; apply/setP => u.
by rewrite !inE memberE andbC.
Qed.

Lemma reach_count r S : uniq S -> inside g S ->
  #|reach N r (nodes S)| = count (fun v => Nat.leb r (outside g S v)) S.
Proof.
move=> us ins; rewrite -size_filter -card_nodes ?filter_uniq //; last first.
  by apply/insideP => u; rewrite mem_filter => /andP [_]; exact: (insideP _ _ ins).
congr #|pred_of_set _|; apply/setP => u; rewrite !inE mem_filter lebE outsideE.
by rewrite andbC.
Qed.
End Network.

Lemma not_full g r S (ok : network_ok g) : inside g S -> has (fun v => Nat.ltb (outside g S v) r) S ->
  reach (@N g) r (nodes g S) != nodes g S.
Proof.
move=> /insideP ins /hasP [v vS]; rewrite ltbE => less; apply/eqP => /setP /(_ (Ordinal (ins v vS))).
by rewrite !inE /= vS /= -outsideE //= leqNgt less.
Qed.

Lemma nodes_full g S : inside g S -> ~~ nilp S -> nodes g S != set0.
Proof.
case: S => // v S /insideP ins _; apply/set0Pn; exists (Ordinal (ins v (mem_head _ _))).
by rewrite inE /= mem_head.
Qed.

Theorem refutes_sound g r s S1 S2 : refutes_check g r s S1 S2 -> ~ robust (@N g) r s.
Proof.
move=> /and5P [ok dis ins e1 /and4P [e2 h1 h2 few]].
move: dis; rewrite distinctE cat_uniq => /and3P [u1 apart u2].
have i1 : inside g S1 by move: ins; rewrite /inside all_cat => /andP [].
have i2 : inside g S2 by move: ins; rewrite /inside all_cat => /andP [].
apply: (@witness_refutes _ _ r s (nodes g S1) (nodes g S2)); apply/and5P; split; rewrite ?nodes_full ?not_full //.
  rewrite -setI_eq0; apply/eqP/setP => u; rewrite !inE; apply/andP => -[a b].
  by move/hasPn: apart => /(_ _ b) /=; rewrite a.
by rewrite /= !reach_count // -ltbE.
Qed.

Theorem degrees_sound g r : degrees_check g r -> forall s, robust (@N g) r s.
Proof.
move=> /and3P [ok]; rewrite ltbE => r0 /allP all s; apply: degree_proves => // v.
  by rewrite inE; have [_ _] := row ok v.
have := card_count ok v predT; rewrite count_predT.
have -> : [set u in N v | predT (u : nat)] = N v by apply/setP => u; rewrite !inE andbT.
move=> ->; have := all _ (mem_nth [::] (ltn_ord v)); rewrite lebE div2E card_ord /heard => le.
by apply: leq_trans le; move: (_./2) r0 => q; lia.
Qed.

(* Ranks from an order: 0 in the core, then one for each node. *)
Definition rank_of (core rest : seq nat) v := if v \in core then 0 else (index v rest).+1.

Lemma walks g F before rest v : walk g F before rest -> v \in rest ->
  2 * F + 1 <= count (fun u => (u \in before) || (index u rest < index v rest)) (heard g v).
Proof.
elim: rest before => //= w t IH before /andP [first others].
rewrite inE eq_sym; case: (w =P v) => [<- _ | /eqP wv /= vt].
  move: first; rewrite lebE => le; apply: leq_trans le _.
  by apply: sub_count => u; rewrite memberE => ->.
apply: leq_trans (IH _ others vt) _; apply: sub_count => u.
by rewrite inE [w == u]eq_sym; case: (u == w) => //=; rewrite ?orbT.
Qed.

Section Order.
Variables (g : network) (F : nat) (core rest : seq nat).
Hypothesis passes : order_check g F core rest.
Let V := [finType of 'I_(size g)].
Definition rank (v : V) := rank_of core rest v.

Lemma rank_core (v : V) : (rank v == 0) = ((v : nat) \in core).
Proof. by rewrite /rank /rank_of; case: ifP. Qed.

Lemma core_nodes : ranks.core rank = nodes g core.
Proof. by apply/setP => v; rewrite !inE rank_core. Qed.

Theorem order_sound :
  (forall v : V, rank v <= size rest) /\
  (forall v : V, v \in ranks.core rank -> F + #|ranks.core rank|./2 <= #|N v :&: ranks.core rank|) /\
  (forall v : V, 0 < rank v -> 2 * F + 1 <= #|[set u in N v | rank u < rank v]|).
Proof.
move: passes => /and5P [ok dis ins cnt /and3P [least all walked]].
have {}cnt : size core + size rest = size g by apply/eqP; move: cnt; rewrite eqbE.
have ic : inside g core by move: ins; rewrite /inside all_cat => /andP [].
move: (dis); rewrite distinctE => u; have uc : uniq core by move: u; rewrite cat_uniq => /and3P [].
have everybody (v : V) : (v : nat) \in core ++ rest.
  have full : nodes g (core ++ rest) = setT.
    by apply/eqP; rewrite eqEcard subsetT cardsT card_ord card_nodes ?size_cat ?cnt ?leqnn.
  by have := in_setT v; rewrite -full inE.
split; [|split] => v.
- rewrite /rank /rank_of; case: ifP => // vc.
  by have := everybody v; rewrite mem_cat vc /= -index_mem.
- rewrite core_nodes card_nodes // inE => vc; have := allP all _ vc; rewrite lebE div2E => le.
  apply: leq_trans le _; rewrite -(card_count ok); apply: subset_leq_card.
  by apply/subsetP => w; rewrite !inE memberE.
- move=> pos; have vc : (v : nat) \notin core by rewrite -rank_core -lt0n.
  have vr : (v : nat) \in rest by have := everybody v; rewrite mem_cat (negPf vc).
  apply: leq_trans (walks walked vr) _; rewrite -(card_count ok); apply/subset_leq_card/subsetP => w.
  rewrite !inE => /andP [-> /=]; rewrite /rank /rank_of (negPf vc); case: ifP => //= _.
Qed.

(* thm:ranks for a network that does not change. *)
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.
Theorem order_agrees (R : realFieldType) (A : {set V}) (b : R) (view : nat -> V -> V -> R) (y : nat -> V -> R) p D :
  0 <= b -> (forall p, round A F b (@N g) (view p) (y p) (y p.+1)) ->
  (exists told : V -> R, forall i j, i \notin A -> i \in ranks.core rank -> j \in N i -> j \in ranks.core rank ->
     view p i j = told j) ->
  spread A (y p) D -> spread A (y (p + size rest).+1) ((1 - b ^+ (size rest).+1 / 2%:R) * D).
Proof.
have [top [inner outer]] := order_sound.
move=> b0 rounds voice; apply: (@ranks V R A F b b0 (fun _ => @N g) view y rounds rank (size rest)) => //.
- by move=> q i iA; exact: outer.
- by move=> i iA; exact: inner.
Qed.
End Order.
