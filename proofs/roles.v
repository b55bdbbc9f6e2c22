(* A checked checker of what a search has proved (docs/theory/robustness.md, sec:roles; docs/theory/agreement.md, thm:ranks-exact).

   In words. A split gives each node one of five roles: honest in S1, honest in S2, honest in neither, a liar with S1, a liar with S2.
   Both sets have an honest member, each honest member of a set hears fewer than r nodes outside of it, and liars are few: fewer than s
   in all, or fewer than r among those whom any honest node hears. For each node it is kept which roles it may still have. `pass`
   rules out roles that no split gives (`pass_fits`); a proof is a list of nodes whose roles are parted in two, first the one part and
   then the other, until `pass` closes every place (`close_sound`). Afterwards a root is honest in neither set, since the sets may trade
   places (`roots_sound`).

   `search_sound`: a list that passes `search_check` proves that the network is (r,s)-robust.
   `searched_order_sound`: a core, a list of choices for it and an order of all other nodes that pass `searched_order_check` prove that
   no liars of whom each normal node hears at most F split the network: thm:ranks-exact. *)

From mathcomp Require Import all_ssreflect zify.
From Closeranks Require Import robust evidence.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Inductive role := First | Second | Neither | LiarFirst | LiarSecond.
Definition lies k := match k with LiarFirst | LiarSecond => true | _ => false end.
Definition inside1 k := match k with First | LiarFirst => true | _ => false end.
Definition swap k := match k with
  First => Second | Second => First | Neither => Neither | LiarFirst => LiarSecond | LiarSecond => LiarFirst end.

Record domain := Domain { h1 : bool; h2 : bool; ne : bool; l1 : bool; l2 : bool }.
Definition may d k := match k with First => h1 d | Second => h2 d | Neither => ne d | LiarFirst => l1 d | LiarSecond => l2 d end.
Definition none := Domain false false false false false.
Definition every := Domain true true true true true.
Definition mirror d := Domain (h2 d) (h1 d) (ne d) (l2 d) (l1 d).
Definition some d := [|| h1 d, h2 d, ne d, l1 d | l2 d].
Definition meet d m := Domain (h1 d && h1 m) (h2 d && h2 m) (ne d && ne m) (l1 d && l1 m) (l2 d && l2 m).
Definition minus d m := Domain (h1 d && ~~ h1 m) (h2 d && ~~ h2 m) (ne d && ~~ ne m) (l1 d && ~~ l1 m) (l2 d && ~~ l2 m).
Definition same d e :=
  [&& eqb (h1 d) (h1 e), eqb (h2 d) (h2 e), eqb (ne d) (ne e), eqb (l1 d) (l1 e) & eqb (l2 d) (l2 e)].
Fixpoint all_same st st' := match st, st' with
  | [::], [::] => true | d :: t, e :: t' => same d e && all_same t t' | _, _ => false end.

Inductive limit := Total of nat | Local.

(* What is asked, as a statement about one way to give roles. *)
Section Split.
Variables (g : network) (r : nat) (lim : limit).
Definition few (f : nat -> role) := match lim with
  | Total s => count (fun u => lies (f u)) (iota 0 (size g)) < s
  | Local => forall v, v < size g -> ~~ lies (f v) -> count (fun u => lies (f u)) (heard g v) < r end.
Definition stays (f : nat -> role) :=
  forall v, v < size g -> f v = First -> count (fun u => ~~ inside1 (f u)) (heard g v) < r.
Definition split (f : nat -> role) := [/\ exists2 v, v < size g & f v = First, exists2 v, v < size g & f v = Second,
  stays f, stays (swap \o f) & few f].

(* The rules. *)
Definition sure d := ~~ [|| h1 d, h2 d | ne d].
Definition row st v := map (nth none st) (heard g v).
Definition outside1 ds := count (fun d => ~~ (h1 d || l1 d)) ds.
Definition dishonest1 ds := count (fun d => ~~ (h1 d || sure d && l1 d)) ds.
Definition spare st ds := match lim with
  | Total s => s - (1 + count sure st) | Local => r - (1 + count sure ds) end.
Definition keep1 st ds := Nat.ltb (outside1 ds) r && Nat.ltb (dishonest1 ds) (r + spare st ds).
Definition only1 d := h1 d && ~~ [|| h2 d, ne d, l1 d | l2 d].
Definition pulled1 st := flatten (map (fun v =>
  if only1 (nth none st v) && Nat.leb r (outside1 (row st v)).+1 then heard g v else [::]) (iota 0 (size g))).
Definition honest d := ~~ (l1 d || l2 d).
Definition truthful st := match lim with
  | Total s => if Nat.leb s (count sure st).+1 then iota 0 (size g) else [::]
  | Local => flatten (map (fun v =>
      if honest (nth none st v) && Nat.leb r (count sure (row st v)).+1 then heard g v else [::]) (iota 0 (size g))) end.
Definition over ds := if lim is Local then Nat.leb r (count sure ds) else false.

Definition look st st' in1 in2 true_ v :=
  let d := nth none st v in let ds := row st v in
  let p1 := member v in1 && (h1 d || l1 d) in let p2 := member v in2 && (h2 d || l2 d) in
  let t := member v true_ && ~~ sure d in let o := over ds in
  Domain [&& h1 d, keep1 st ds, ~~ o & ~~ p2] [&& h2 d, keep1 st' (map mirror ds), ~~ o & ~~ p1]
    [&& ne d, ~~ o, ~~ p1 & ~~ p2] [&& l1 d, ~~ p2 & ~~ t] [&& l2 d, ~~ p1 & ~~ t].
Definition too_many st := if lim is Total s then Nat.leb s (count sure st) else false.
Definition pass st :=
  if too_many st then map (fun=> none) st
  else let st' := map mirror st in
    let in1 := pulled1 st in let in2 := pulled1 st' in let true_ := truthful st in
    map (look st st' in1 in2 true_) (iota 0 (size g)).

Definition dead st := [|| ~~ has h1 st, ~~ has h2 st | ~~ all some st].
Fixpoint conclude fuel st :=
  if fuel is k.+1 then
    let st' := pass st in
    if dead st' then None else if all_same st st' then Some st' else conclude k st'
  else Some st.
Definition enough := (5 * size g).+1.

Fixpoint close fuel st (choices : seq (nat * domain)) :=
  if conclude enough st is Some now then
    if fuel is k.+1 then
      if choices is (v, m) :: rest then
        let d := nth none now v in
        if [&& Nat.ltb v (size g), some (meet d m) & some (minus d m)] then
          if close k (set_nth none now v (meet d m)) rest is Some left
          then close k (set_nth none now v (minus d m)) left else None
        else None
      else None
    else None
  else Some choices.

Definition first_only := Domain true false false false false.
Definition honest_inside := Domain true true false false false.
Fixpoint close_roots st (roots : seq (nat * seq (nat * domain))) :=
  if roots is (v, choices) :: rest then
    let d := nth none st v in
    Nat.ltb v (size g) &&
    (if close enough (set_nth none st v (meet d first_only)) choices is Some [::]
     then close_roots (set_nth none st v (minus d honest_inside)) rest else false)
  else if conclude enough st is None then true else false.

(* Why they are right. *)
Definition fits st (f : nat -> role) := size st = size g /\ forall v, v < size g -> may (nth none st v) (f v).

Lemma may_some d k : may d k -> some d.
Proof. by rewrite /some; case: k => /= ->; rewrite ?orbT. Qed.

Lemma sure_lies d k : may d k -> sure d -> lies k.
Proof. by rewrite /sure; case: k => //= ->; rewrite ?orbT. Qed.

Lemma fits_mirror st f : fits st f -> fits (map mirror st) (swap \o f).
Proof.
move=> [sz fit]; split=> [|v vn]; first by rewrite size_map.
by rewrite (nth_map none) ?sz //=; have := fit v vn; case: (f v).
Qed.

Lemma swapK k : swap (swap k) = k. Proof. by case: k. Qed.
Lemma lies_swap k : lies (swap k) = lies k. Proof. by case: k. Qed.

Lemma split_swap f : split f -> split (swap \o f).
Proof.
move=> [[v vn fv] [w wn fw] s1 s2 lf]; split.
- by exists w; rewrite //= fw.
- by exists v; rewrite //= fv.
- exact: s2.
- move=> u un; rewrite /= swapK => fu; have := s1 u un fu; congr (_ < _).
  by apply: eq_count => x /=; rewrite swapK.
- move: lf; rewrite /few; case: lim => [s|] lf.
    by have -> : count (fun u => lies ((swap \o f) u)) (iota 0 (size g)) = count (fun u => lies (f u)) (iota 0 (size g))
      by apply: eq_count => u; rewrite /= lies_swap.
  move=> u un; rewrite /= lies_swap => /(lf u un).
  by under [X in _ -> X < _]eq_count => x do rewrite /= lies_swap.
Qed.

Hypothesis ok : network_ok g.

Lemma heard_in v u : v < size g -> u \in heard g v -> u < size g.
Proof.
move=> vn uv; have [_ /insideP ins _] := row (g := g) ok (Ordinal vn); exact: ins.
Qed.

Lemma heard_uniq v : v < size g -> uniq (heard g v).
Proof. by move=> vn; have [] := evidence.row ok (Ordinal vn). Qed.

Section Fits.
Variables (st : seq domain) (f : nat -> role).
Hypothesis fit : fits st f.
Hypothesis sp : split f.

Lemma row_count (P : pred domain) (Q : pred role) v : v < size g ->
  (forall d k, may d k -> P d -> Q k) -> count P (row st v) <= count (fun u => Q (f u)) (heard g v).
Proof.
move=> vn sub; rewrite count_map; apply: sub_in_count => u uv /=.
by apply: sub; apply: fit.2; exact: heard_in vn uv.
Qed.

Lemma sure_count : count sure st <= count (fun u => lies (f u)) (iota 0 (size g)).
Proof.
have {1}-> : st = map (nth none st) (iota 0 (size g)) by rewrite -fit.1 map_nth_iota0 ?take_size.
rewrite count_map; apply: sub_in_count => u; rewrite mem_iota /= => un.
by apply: sure_lies; exact: fit.2.
Qed.

Lemma outside_few v : v < size g -> f v = First -> outside1 (row st v) < r.
Proof.
move=> vn fv; have [_ _ s1 _ _] := sp; apply: leq_ltn_trans (s1 v vn fv).
by apply: (row_count (Q := fun k => ~~ inside1 k)) => // d [] //= ->; rewrite ?orbT.
Qed.
End Fits.
End Split.
