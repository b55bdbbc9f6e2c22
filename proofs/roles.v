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

Arguments close : simpl never.

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
have ev' : even (set_nth none st v (minus (nth none st v) honest_inside)).
  move=> u; rewrite nth_set_nth /=; case: eqP => [_ | _]; last exact: ev.
  have n1 : l1 (nth none st v) = l2 (nth none st v) := congr1 l2 (ev v).
  by rewrite /minus /mirror /= !andbF n1.
have later : may (minus (nth none st v) honest_inside) (f v) -> False.
  by move=> mv; apply: (IH _ f ev' shut sp); exact: put_fits.
have mv := fit.2 v vn; case fv : (f v) mv later => /= mv later.
- exact: no sp fit fv.
- by apply: (no (swap \o f)); [exact: split_swap | exact: even_fits | rewrite /= fv].
- by apply: later; rewrite mv.
- by apply: later; rewrite mv.
- by apply: later; rewrite mv.
Qed.
End Split.

Definition start (n : nat) := nseq n every.
Lemma start_even n : even (start n).
Proof. by move=> v; rewrite nth_nseq; case: ifP. Qed.
Lemma start_fits g f : fits g (start (size g)) f.
Proof. by split=> [|v vn]; rewrite ?size_nseq // nth_nseq vn; case: (f v). Qed.

Definition search_check g r s roots :=
  [&& network_ok g, Nat.ltb 0 r, Nat.ltb 0 s & close_roots g r (Total s) (start (size g)) roots].

Definition place u (s : seq nat) := find (Nat.eqb u) s.
Definition core_network (g : network) core : network :=
  map (fun v => map (fun u => place u core) (filter (fun u => member u core) (heard g v))) core.
Definition searched_order_check g F core rest roots :=
  [&& network_ok g, distinct (core ++ rest), inside g (core ++ rest), Nat.eqb (size core + size rest) (size g),
      walk g F core rest & close_roots (core_network g core) F.+1 Local (start (size core)) roots].

(* Sets as roles. *)
Section Sets.
Variables (g : network) (ok : network_ok g) (r : nat) (lim : limit) (D S1 S2 : {set 'I_(size g)}).
Definition kind u := if u \in S1 then (if u \in D then LiarFirst else First)
  else if u \in S2 then (if u \in D then LiarSecond else Second) else if u \in D then LiarFirst else Neither.
Definition roles_of u := if insub u is Some i then kind i else Neither.
Definition few_in_set : Prop := match lim with
  | Total s => is_true (#|D| < s) | Local => forall v, v \notin D -> #|N v :&: D| < r end.
Hypothesis dis : [disjoint S1 & S2].
Hypotheses (n1 : S1 :\: D != set0) (n2 : S2 :\: D != set0).
Hypothesis stay1 : forall v, v \in S1 :\: D -> #|N v :\: S1| < r.
Hypothesis stay2 : forall v, v \in S2 :\: D -> #|N v :\: S2| < r.
Hypothesis fewD : few_in_set.

Lemma roles_ofE (u : 'I_(size g)) : roles_of u = kind u.
Proof. by rewrite /roles_of valK. Qed.

Lemma lies_kind u : lies (kind u) = (u \in D).
Proof. rewrite /kind; by case: (_ \in S1); case: (_ \in S2); case: (_ \in D). Qed.

Lemma lies_heard (v : 'I_(size g)) : count (fun u => lies (roles_of u)) (heard g v) = #|N v :&: D|.
Proof.
rewrite -(card_count ok); congr #|pred_of_set _|; apply/setP => u.
by rewrite !inE roles_ofE lies_kind.
Qed.

Lemma lies_all : count (fun u => lies (roles_of u)) (iota 0 (size g)) = #|D|.
Proof.
rewrite -size_filter -(@card_nodes g) ?filter_uniq ?iota_uniq //; last first.
  by apply/insideP => u; rewrite mem_filter mem_iota => /andP [].
congr #|pred_of_set _|; apply/setP => u.
by rewrite inE mem_filter mem_iota leq0n add0n ltn_ord roles_ofE lies_kind !andbT.
Qed.

Lemma split_of_sets : split g r lim roles_of.
Proof.
split.
- have [v] := set0Pn _ n1; rewrite inE => /andP [vD v1]; exists v => //.
  by rewrite roles_ofE /kind v1 (negPf vD).
- have [v] := set0Pn _ n2; rewrite inE => /andP [vD v2]; exists v => //.
  by rewrite roles_ofE /kind (disjointFl dis v2) v2 (negPf vD).
- move=> v vn; rewrite -[v]/(val (Ordinal vn)) roles_ofE => kv.
  have /stay1 : Ordinal vn \in S1 :\: D by move: kv; rewrite /kind inE; do ?case: (Ordinal vn \in _).
  apply: leq_ltn_trans; rewrite -(card_count ok); apply/subset_leq_card/subsetP => u.
  by rewrite !inE roles_ofE /kind => /andP [-> ]; do ?case: (u \in _).
- move=> v vn; rewrite /= -[v]/(val (Ordinal vn)) roles_ofE => kv.
  have /stay2 : Ordinal vn \in S2 :\: D by move: kv; rewrite /kind inE; do ?case: (Ordinal vn \in _).
  apply: leq_ltn_trans; rewrite -(card_count ok); apply/subset_leq_card/subsetP => u.
  rewrite !inE /= roles_ofE /kind => /andP [-> ]; case u2 : (u \in S2) => //.
  by rewrite (disjointFl dis u2); do ?case: (u \in _).
- move: fewD; rewrite /few_in_set /few; case: lim => [s|] fw; first by rewrite lies_all.
  move=> v vn; rewrite -[v]/(val (Ordinal vn)) roles_ofE lies_kind => /fw.
  by rewrite lies_heard.
Qed.
End Sets.

Theorem search_sound g r s roots : search_check g r s roots -> robust (@N g) r s.
Proof.
move=> /and4P [ok _ _ shut] S1 S2 n1 n2 dis.
have [/eqP E|r1] := boolP (reach (@N g) r S1 == S1); first by constructor 1.
have [/eqP E|r2] := boolP (reach (@N g) r S2 == S2); first by constructor 2.
constructor 3; rewrite leqNgt; apply/negP => fw.
pose D := reach (@N g) r S1 :|: reach (@N g) r S2.
have sub S : reach (@N g) r S \subset S by apply/subsetP => v; rewrite inE => /andP [].
have inD1 v : v \in S1 -> (v \in D) = (v \in reach (@N g) r S1).
  by move=> v1; rewrite inE [v \in reach _ _ S2]inE (disjointFr dis v1) orbF.
have inD2 v : v \in S2 -> (v \in D) = (v \in reach (@N g) r S2).
  by move=> v2; rewrite inE [v \in reach _ _ S1]inE (disjointFl dis v2).
have stay (S : {set 'I_(size g)}) v : v \in S -> v \notin reach (@N g) r S -> #|N v :\: S| < r.
  by move=> vS; rewrite inE vS -ltnNge.
apply: (roots_sound ok (@start_even _) shut _ (start_fits _ (roles_of D S1 S2))).
apply: split_of_sets => //.
- apply: contraNneq r1 => empty; rewrite eqEsubset sub; apply/subsetP => v v1.
  by have := in_set0 v; rewrite -empty inE v1 andbT inD1 // => /negbFE.
- apply: contraNneq r2 => empty; rewrite eqEsubset sub; apply/subsetP => v v2.
  by have := in_set0 v; rewrite -empty inE v2 andbT inD2 // => /negbFE.
- by move=> v; rewrite inE => /andP [vD v1]; apply: stay => //; rewrite -inD1.
- by move=> v; rewrite inE => /andP [vD v2]; apply: stay => //; rewrite -inD2.
- by apply: leq_ltn_trans fw; rewrite cardsU leq_subr.
Qed.

(* thm:ranks-exact *)
Section Order.
Variables (g : network) (F : nat) (core rest : seq nat).
Hypotheses (ok : network_ok g) (dis : uniq (core ++ rest)) (ins : inside g (core ++ rest)).
Hypothesis everybody : forall v, v < size g -> v \in core ++ rest.
Hypothesis walked : walk g F core rest.

Lemma placeE u : place u core = index u core.
Proof. by apply: eq_find => w /=; rewrite eqbE eq_sym. Qed.

Lemma core_in v : v \in core -> v < size g.
Proof. by move=> vc; apply: (insideP _ _ ins); rewrite mem_cat vc. Qed.

Lemma core_heard i : i < size core -> heard (core_network g core) i =
  map (fun u => place u core) (filter (fun u => member u core) (heard g (nth 0 core i))).
Proof. by move=> ic; rewrite /heard (nth_map 0). Qed.

Lemma core_count (P : pred role) (f : nat -> role) i : i < size core ->
  count (fun k => P (f (nth 0 core k))) (heard (core_network g core) i) <= count (fun u => P (f u)) (heard g (nth 0 core i)).
Proof.
move=> ic; rewrite core_heard // count_map count_filter; apply: sub_count => u /= /andP [Pu].
by rewrite memberE => uc; move: Pu; rewrite placeE nth_index.
Qed.

Lemma core_ok : network_ok (core_network g core).
Proof.
apply/allP => i; rewrite mem_iota /= size_map => ic; rewrite core_heard //.
have vc := mem_nth 0 ic; have [us _ no] := evidence.row ok (Ordinal (core_in vc)).
apply/and3P; split.
- rewrite distinctE map_inj_in_uniq ?filter_uniq // => u w; rewrite !mem_filter !memberE !placeE.
  by move=> /andP [uc _] /andP [wc _] e; rewrite -(nth_index 0 uc) e nth_index.
- apply/insideP => k /mapP [u]; rewrite mem_filter memberE placeE => /andP [uc _] ->.
  by rewrite size_map index_mem.
- rewrite memberE; apply/negP => /mapP [u]; rewrite mem_filter memberE placeE => /andP [uc uv] e.
  have vu : nth 0 core i = u by rewrite e nth_index.
  by move: no; rewrite /= {1}vu uv.
Qed.

Lemma rest_not_first f before others : split g F.+1 Local f -> walk g F before others ->
  {in others, forall v, v < size g} -> {in before, forall u, f u <> First} -> {in others, forall v, f v <> First}.
Proof.
move=> [_ _ s1 _ fw]; elim: others before => //= w t IH before /andP [many later] inn none_before.
have wF : f w <> First.
  move=> fw1; have wn := inn w (mem_head _ _); have out := s1 w wn fw1.
  have := fw w wn; rewrite fw1 => /(_ isT) liars; move: many; rewrite lebE.
  have : count (member^~ before) (heard g w) <=
      count (fun u => ~~ inside1 (f u)) (heard g w) + count (fun u => lies (f u)) (heard g w).
    rewrite -count_predUI; apply: (leq_trans _ (leq_addr _ _)); apply: sub_count => u /=.
    by rewrite memberE => /none_before; case: (f u).
  move=> le1 le2; have := leq_trans le2 le1; lia.
move=> v; rewrite inE => /orP [/eqP -> // | vt]; apply: (IH (w :: before) later) => //.
- by move=> u ut; apply: inn; rewrite inE ut orbT.
- by move=> u; rewrite inE => /orP [/eqP -> // | ub]; exact: none_before.
Qed.

Theorem core_decides roots f :
  close_roots (core_network g core) F.+1 Local (start (size core)) roots -> ~ split g F.+1 Local f.
Proof.
move=> shut sp.
have in_rest : {in rest, forall v, v < size g}.
  by move=> v vr; apply: (insideP _ _ ins); rewrite mem_cat vr orbT.
have in_core h : split g F.+1 Local h -> exists2 v, v \in core & h v = First.
  move=> sph; have [[v vn hv] _ _ _ _] := sph.
  case: (boolP (has (fun u => if h u is First then true else false) core)) => [/hasP [u uc] | /hasPn no].
    by case hu : (h u) => // _; exists u.
  have no_core : {in core, forall u, h u <> First} by move=> u uc hu; have := no u uc; rewrite hu.
  have no_rest := rest_not_first sph walked in_rest no_core.
  by have := everybody vn; rewrite mem_cat => /orP [/no_core | /no_rest].
have [v vc fv] := in_core f sp.
have [w wc] := in_core _ (split_swap sp); rewrite /= => fw.
have {}fw : f w = Second by case: (f w) fw.
have [_ _ s1 s2 fwl] := sp.
have sz : size (core_network g core) = size core by rewrite size_map.
apply: (@roots_sound _ F.+1 Local core_ok (start (size core)) roots (fun i => f (nth 0 core i))) => //.
- exact: start_even.
- split.
  + by exists (index v core); rewrite ?sz ?index_mem ?nth_index.
  + by exists (index w core); rewrite ?sz ?index_mem ?nth_index.
  + move=> i; rewrite sz => ic fi; apply: leq_ltn_trans (s1 _ (core_in (mem_nth 0 ic)) fi).
    exact: (core_count (fun k => ~~ inside1 k) f ic).
  + move=> i; rewrite sz => ic fi; apply: leq_ltn_trans (s2 _ (core_in (mem_nth 0 ic)) fi).
    exact: (core_count (fun k => ~~ inside1 (swap k)) f ic).
  + move=> i; rewrite sz => ic fi; apply: leq_ltn_trans (fwl _ (core_in (mem_nth 0 ic)) fi).
    exact: (core_count lies f ic).
- by rewrite -sz; exact: start_fits.
Qed.
End Order.

Theorem searched_order_sound g F core rest roots : searched_order_check g F core rest roots ->
  forall D S1 S2 : {set 'I_(size g)}, (forall v, v \notin D -> #|N v :&: D| <= F) ->
  [disjoint S1 & S2] -> S1 :\: D != set0 -> S2 :\: D != set0 ->
  ~ forall S, S = S1 \/ S = S2 -> forall v, v \in S :\: D -> #|N v :\: S| <= F.
Proof.
move=> /and5P [ok dis ins cnt /andP [walked shut]] D S1 S2 fewD apart n1 n2 stay.
have u : uniq (core ++ rest) by rewrite -distinctE.
have everybody v : v < size g -> v \in core ++ rest.
  move=> vn; have {}cnt : size core + size rest = size g by apply/eqP; move: cnt; rewrite eqbE.
  have full : nodes g (core ++ rest) = setT.
    by apply/eqP; rewrite eqEcard subsetT cardsT card_ord card_nodes ?size_cat ?cnt ?leqnn.
  by have := in_setT (Ordinal vn); rewrite -full inE.
have sp : split g F.+1 Local (roles_of D S1 S2).
  by apply: split_of_sets => // v; [apply: (stay S1) | apply: (stay S2)]; auto.
exact: (core_decides ok u ins everybody walked shut sp).
Qed.
