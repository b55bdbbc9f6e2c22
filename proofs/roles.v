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

Lemma sub_in_count (T : eqType) (P Q : pred T) s : {in s, forall x, P x -> Q x} -> count P s <= count Q s.
Proof.
elim: s => //= x s IH sub; apply: leq_add.
  by have := sub x (mem_head _ _); case: (P x) => // /(_ isT) ->.
by apply: IH => y ys; apply: sub; rewrite inE ys orbT.
Qed.

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
Definition few (f : nat -> role) : Prop := match lim with
  | Total s => is_true (count (fun u => lies (f u)) (iota 0 (size g)) < s)
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
      if choices is (v, m) :: others then
        let d := nth none now v in
        if [&& Nat.ltb v (size g), some (meet d m) & some (minus d m)] then
          if close k (set_nth none now v (meet d m)) others is Some more
          then close k (set_nth none now v (minus d m)) more else None
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
move=> vn uv; have [_ /insideP ins _] := evidence.row ok (Ordinal vn); exact: ins.
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

(* Of those whom v hears, liars that are not certain yet. *)
Lemma spare_enough v : v < size g -> f v = First ->
  count (fun u => lies (f u) && ~~ sure (nth none st u)) (heard g v) <= spare st (row st v).
Proof.
move=> vn fv; have [_ _ _ _ fw] := sp.
have parts s : {in s, forall u, u < size g} -> count (fun u => lies (f u)) s =
    count (fun u => lies (f u) && ~~ sure (nth none st u)) s + count (fun u => sure (nth none st u)) s.
  elim: s => //= u s IH ins; rewrite IH; last by move=> w ws; apply: ins; rewrite inE ws orbT.
  have := fit.2 u (ins u (mem_head _ _)); case su : (sure _); last by rewrite andbT; lia.
  by move=> /sure_lies /(_ su) ->; rewrite andbF; lia.
move: fw; rewrite /few /spare; case: lim => [s fs|loc].
- have all := parts (iota 0 (size g)); move: fs; rewrite all; last by move=> u; rewrite mem_iota.
  have -> : count (fun u => sure (nth none st u)) (iota 0 (size g)) = count sure st.
    by rewrite -(count_map (nth none st) sure) -{1}fit.1 map_nth_iota0 ?take_size.
  have : count (fun u => lies (f u) && ~~ sure (nth none st u)) (heard g v) <=
      count (fun u => lies (f u) && ~~ sure (nth none st u)) (iota 0 (size g)).
    rewrite -!size_filter; apply: uniq_leq_size; first by rewrite filter_uniq ?heard_uniq.
    move=> u; rewrite !mem_filter mem_iota => /andP [-> uv] /=; exact: heard_in vn uv.
  lia.
- have := loc v vn; rewrite fv => /(_ isT); rewrite (parts (heard g v)); last by move=> u; exact: heard_in.
  have -> : count sure (row st v) = count (fun u => sure (nth none st u)) (heard g v) by rewrite count_map.
  lia.
Qed.

Lemma dishonest_few v : v < size g -> f v = First -> dishonest1 (row st v) < r + spare st (row st v).
Proof.
move=> vn fv; have [_ _ s1 _ _] := sp; have out := s1 v vn fv; have sp1 := spare_enough vn fv.
rewrite /dishonest1 count_map /=.
apply: (@leq_ltn_trans (count (fun u => ~~ inside1 (f u)) (heard g v) +
   count (fun u => lies (f u) && ~~ sure (nth none st u)) (heard g v))); last by lia.
rewrite -count_predUI; apply: (leq_trans _ (leq_addr _ _)); apply: sub_in_count => u uv /=.
have := fit.2 u (heard_in vn uv); case: (f u) => //= ->; rewrite ?orbT ?andbT //.
by case: (h1 _); case: (sure _).
Qed.

Lemma keeps v : v < size g -> f v = First -> keep1 st (row st v).
Proof. by move=> vn fv; rewrite /keep1 !ltbE outside_few ?dishonest_few. Qed.

Lemma only_first v : v < size g -> only1 (nth none st v) -> f v = First.
Proof.
move=> vn /andP [_ no]; have := fit.2 v vn; move: no.
by case: (f v) => //= no yes; move: no; rewrite yes ?orbT.
Qed.

Lemma sure_row v : v < size g -> count sure (row st v) <= count (fun u => lies (f u)) (heard g v).
Proof. by move=> vn; apply: row_count => // d k; exact: sure_lies. Qed.

Lemma not_over v : v < size g -> over (row st v) -> lies (f v).
Proof.
move=> vn; rewrite /over; have [_ _ _ _] := sp; rewrite /few; case: lim => // loc.
by rewrite lebE => le; apply/negPn/negP => /(loc v vn); rewrite ltnNge (leq_trans le (sure_row vn)).
Qed.

Lemma not_too_many : too_many st = false.
Proof.
rewrite /too_many; have [_ _ _ _] := sp; rewrite /few; case: lim => // s less.
by rewrite lebE leqNgt (leq_ltn_trans sure_count less).
Qed.

(* One more node outside would be too many. *)
Lemma pulled_inside u : u < size g -> member u (pulled1 st) -> h1 (nth none st u) || l1 (nth none st u) -> inside1 (f u).
Proof.
rewrite memberE => un /flatten_mapP [v]; rewrite mem_iota /= => vn.
case: ifP => // /andP [only]; rewrite lebE => full uv may_in; have fv := only_first vn only.
have [_ _ s1 _ _] := sp; have := s1 v vn fv; apply: contraTT => out; rewrite -leqNgt.
apply: leq_trans full _; rewrite /outside1 count_map.
have split_at (P : pred nat) : count P (heard g v) = P u + count P (rem u (heard g v)).
  by rewrite (permP (perm_to_rem uv)).
rewrite !split_at /= out may_in add0n add1n ltnS; apply: sub_in_count => w wr.
have := fit.2 w (heard_in vn (mem_rem wr)); case: (f w) => //= -> //; rewrite orbT //.
Qed.

Lemma truthful_honest u : u < size g -> member u (truthful st) -> ~~ sure (nth none st u) -> ~~ lies (f u).
Proof.
have [_ _ _ _] := sp; rewrite memberE /few /truthful => fw un.
have count_more (s : seq nat) : u \in s -> {in s, forall w, w < size g} -> ~~ sure (nth none st u) -> lies (f u) ->
    (count (fun w => sure (nth none st w)) s).+1 <= count (fun w => lies (f w)) s.
  move=> us ins su lu; rewrite !(permP (perm_to_rem us)) /= (negPf su) lu add0n add1n ltnS.
  by apply: sub_in_count => w wr; apply: sure_lies; apply: fit.2; exact: ins (mem_rem wr).
move: fw; case: lim => [s fs | loc].
  case: ifP => //; rewrite lebE mem_iota => full _ su; apply/negP => lu.
  have := count_more (iota 0 (size g)); rewrite mem_iota => /(_ un) /(_ _ su lu).
  have -> : count (fun w => sure (nth none st w)) (iota 0 (size g)) = count sure st.
    by rewrite -(count_map (nth none st) sure) -{1}fit.1 map_nth_iota0 ?take_size.
  move=> /(_ (fun w => _)) more; have {}more : (count sure st).+1 <= count (fun w => lies (f w)) (iota 0 (size g)).
    by apply: more => w; rewrite mem_iota.
  by move: fs; rewrite ltnNge (leq_trans full more).
move=> /flatten_mapP [v]; rewrite mem_iota /= => vn; case: ifP => // /andP [hv].
rewrite lebE => full uv su; apply/negP => lu.
have vt : ~~ lies (f v).
  by have := fit.2 v vn; move: hv; rewrite /honest; case: (f v) => //= no yes; move: no; rewrite yes ?orbT.
have more := count_more _ uv (fun w => @heard_in v w vn) su lu.
have same_count : count sure (row st v) = count (fun w => sure (nth none st w)) (heard g v) by rewrite count_map.
by have := loc v vn vt; rewrite ltnNge (leq_trans _ more) // -same_count.
Qed.
End Fits.

Lemma row_mirror st v : size st = size g -> v < size g -> map mirror (row st v) = row (map mirror st) v.
Proof.
move=> sz vn; rewrite /row -map_comp; apply/eq_in_map => u uv /=.
by rewrite (nth_map none) // sz; exact: heard_in vn uv.
Qed.

(* No rule rules out what a split gives. *)
Theorem pass_fits st f : fits st f -> split f -> fits (pass st) f.
Proof.
move=> fit sp; have fit' := fits_mirror fit; have sp' := split_swap sp.
rewrite /pass (not_too_many fit sp); split=> [|v vn]; first by rewrite size_map size_iota.
rewrite (nth_map 0) ?size_iota // nth_iota // add0n.
have mv : nth none (map mirror st) v = mirror (nth none st v) by rewrite (nth_map none) // fit.1.
have in1 : member v (pulled1 st) && (h1 (nth none st v) || l1 (nth none st v)) -> inside1 (f v).
  by move=> /andP [a b]; exact: (pulled_inside fit sp vn a b).
have in2 : member v (pulled1 (map mirror st)) && (h2 (nth none st v) || l2 (nth none st v)) -> inside1 (swap (f v)).
  move=> /andP [a b]; have := pulled_inside fit' sp' vn a; rewrite mv; exact.
have true_ : member v (truthful st) && ~~ sure (nth none st v) -> ~~ lies (f v).
  by move=> /andP [a b]; exact: (truthful_honest fit sp vn a b).
have over_ : over (row st v) -> lies (f v) := not_over fit sp vn.
have k1 : f v = First -> keep1 st (row st v) := keeps fit sp vn.
have k2 : f v = Second -> keep1 (map mirror st) (map mirror (row st v)).
  by move=> fv; rewrite row_mirror ?fit.1 //; apply: (keeps fit' sp' vn); rewrite /= fv.
have := fit.2 v vn; rewrite /look; move: in1 in2 true_ over_ k1 k2.
move: (_ && (h1 _ || l1 _)) (_ && (h2 _ || l2 _)) (_ && ~~ sure _) (over _) => p1 p2 t o.
case: (f v) => /= in1 in2 true_ over_ k1 k2 ->; rewrite ?(k1 erefl) ?(k2 erefl) /=.
- by case: o over_ => [/(_ isT)|_] //; case: p2 in2 => // /(_ isT).
- by case: o over_ => [/(_ isT)|_] //; case: p1 in1 => // /(_ isT).
- by case: o over_ => [/(_ isT)|_] //; case: p1 in1 => [/(_ isT)|_] //; case: p2 in2 => // /(_ isT).
- by case: p2 in2 => [/(_ isT)|_] //; case: t true_ => // /(_ isT).
- by case: p1 in1 => [/(_ isT)|_] //; case: t true_ => // /(_ isT).
Qed.

Lemma has_role (P : pred domain) st f : fits st f -> (exists2 v, v < size g & P (nth none st v)) -> has P st.
Proof. by move=> fit [v vn Pv]; apply/(has_nthP none); exists v; rewrite ?fit.1. Qed.

Lemma not_dead st f : fits st f -> split f -> dead st = false.
Proof.
move=> fit [[v vn fv] [w wn fw] _ _ _]; rewrite /dead.
have -> : has h1 st by apply: (has_role fit); exists v => //; have := fit.2 v vn; rewrite fv.
have -> : has h2 st by apply: (has_role fit); exists w => //; have := fit.2 w wn; rewrite fw.
have -> // : all some st.
apply/(all_nthP none) => u; rewrite fit.1 => un; exact: may_some (fit.2 u un).
Qed.

Lemma conclude_fits fuel st f : fits st f -> split f -> if conclude fuel st is Some now then fits now f else False.
Proof.
elim: fuel st => //= k IH st fit sp; have fit' := pass_fits fit sp.
by rewrite (not_dead fit' sp); case: ifP => // _; exact: IH.
Qed.

Arguments conclude : simpl never.
Lemma put_fits st f v d : fits st f -> v < size g -> may d (f v) -> fits (set_nth none st v d) f.
Proof.
move=> [sz fit] vn dv; split=> [|u un]; first by rewrite size_set_nth sz (maxn_idPr vn).
by rewrite nth_set_nth /=; case: eqP => [-> | _]; [exact: dv | exact: fit].
Qed.

Lemma parted d m k : may d k -> may (meet d m) k \/ may (minus d m) k.
Proof. by case: k => /= ->; case: (h1 m) (h2 m) (ne m) (l1 m) (l2 m) => [] [] [] [] [] /=; auto. Qed.

Theorem close_sound fuel st choices more f : close fuel st choices = Some more -> split f -> ~ fits st f.
Proof.
elim: fuel st choices more => [|k IH] st choices more /=.
  by move=> shut sp fit; move: shut; have := conclude_fits enough fit sp; case: (conclude _ _).
move=> shut sp fit; move: shut; have := conclude_fits enough fit sp; case: (conclude _ _) => // now fit'.
case: choices => // -[v m] others; case: ifP => // /and3P [vn _ _]; rewrite ltbE in vn.
case E : (close k _ others) => [after_|] // shut.
have [dv | dv] := parted m (fit'.2 v vn).
  exact: IH E sp (put_fits fit' vn dv).
exact: IH shut sp (put_fits fit' vn dv).
Qed.

(* Roots. *)
Definition even st := forall v, mirror (nth none st v) = nth none st v.

Lemma even_fits st f : even st -> fits st f -> fits st (swap \o f).
Proof.
move=> ev [sz fit]; split=> // v vn; rewrite -ev /=.
by have := fit v vn; case: (f v).
Qed.

Theorem roots_sound st roots f : even st -> close_roots st roots -> split f -> ~ fits st f.
Proof.
elim: roots st f => [|[v choices] rest IH] st f ev /=.
  by move=> shut sp fit; move: shut; have := conclude_fits enough fit sp; case: (conclude _ _).
move=> /andP []; rewrite ltbE => vn; case E : (close _ _ _) => [[|]|] // shut sp fit.
have no h : split h -> fits st h -> h v = First -> False.
  move=> sph fith hv; apply: (close_sound E sph); apply: put_fits => //.
  by have := fith.2 v vn; rewrite hv /= => ->.
case fv : (f v).
- exact: no sp fit fv.
- by apply: (no (swap \o f)); [exact: split_swap | exact: even_fits | rewrite /= fv].
all: apply: (IH _ f _ shut sp); last by (apply: put_fits => //; have := fit.2 v vn; rewrite fv /= => ->).
all: by move=> u; rewrite nth_set_nth /=; case: eqP => // _; rewrite -[in RHS](ev v).
Qed.
End Split.
