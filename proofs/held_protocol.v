(* Held links, the protocol (crates/core/src/controller/links/protocol.rs, lem:counted).

   In words. Robot i lists neighbours that it wants to keep. Each of its messages has a number and says of every robot
   whether i lists it and which message of it is the newest that i has. Robot i counts on j while it lists j, once j has
   acknowledged a message that i sent since it lists j. Robot i has a row for j unless i does not list j, the newest message of j
   that i has does not list i, and j has acknowledged a message of the present life of i.

   `counted_is_held`: if normal robot i counts on normal robot j, then j has a row for i, and i one for j. Any number of
   robots; messages are lost, late, doubled and reordered; robots begin anew without memory, alone or for one neighbour;
   robots in A say what they like to whom they like. `anew`: j keeps that row although i forgets everything, if i lists j
   from its first message on. Assumed: the numbers of a normal robot rise over all its lives, and
   nobody sends in the name of a normal robot.

   The network is a set of all messages that were ever sent. Any of them may arrive at any time, any number of times. *)

From mathcomp Require Import all_ssreflect.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Section Protocol.
Variables (V : finType) (A : {set V}).   (* A: malicious *)

(* What a message says of one robot; number 0 stands for no message. *)
Record entry := Entry { listed : bool; acked : nat }.
Record message := Message { number : nat; says : V -> entry }.
(* What a message says to one receiver. *)
Record word := Word { of_number : nat; of_entry : entry }.
Definition word_to (i : V) (m : message) := Word (number m) (says m i).

(* What i holds of j. *)
Record hold := Hold {
  born : nat;              (* number of the last message of i before this began *)
  since : option nat;      (* while i lists j: number of the last message of i before it began to *)
  heard : option word;     (* the newest message of j *)
  known : nat              (* the highest number that j has acknowledged, of those that were sent *)
}.
Definition fresh last := Hold last None None 0.
Definition lists (h : hold) : bool := since h.
Definition list_from last (h : hold) :=
  Hold (born h) (Some (if since h is Some a then a else last)) (heard h) (known h).
Definition release (h : hold) := Hold (born h) None (heard h) (known h).
Definition newer (w : word) (h : hold) := if heard h is Some w' then of_number w' < of_number w else true.
Definition hear last (w : word) (h : hold) :=
  if newer w h then
    let a := acked (of_entry w) in
    Hold (born h) (since h) (Some w) (if a <= last then maxn (known h) a else known h)
  else h.
Definition entry_of (h : hold) := Entry (lists h) (if heard h is Some w then of_number w else 0).
Definition counts (h : hold) := if since h is Some a then a < known h else false.
Definition released (h : hold) :=
  (born h < known h) && (if heard h is Some w then ~~ listed (of_entry w) else false).
Definition active (h : hold) := lists h || ~~ released h.

Record state := State {
  last : V -> nat;                  (* number of the newest message of each robot *)
  holds : V -> V -> hold;           (* holds i j: what i holds of j *)
  sent : V -> message -> Prop       (* all messages that were ever sent by each robot *)
}.

Definition set1 (T : Type) (i : V) (v : T) (f : V -> T) := fun k => if k == i then v else f k.
Definition set2 (i j : V) (h : hold) (f : V -> V -> hold) := set1 i (set1 j h (f i)) f.
Definition add (i : V) (m : message) (f : V -> message -> Prop) :=
  fun k m' => f k m' \/ (k = i /\ m' = m).

Inductive step (s : state) : state -> Prop :=
| Lists i j : step s (State (last s) (set2 i j (list_from (last s i) (holds s i j)) (holds s)) (sent s))
| Releases i j : step s (State (last s) (set2 i j (release (holds s i j)) (holds s)) (sent s))
| Sends i n : last s i < n ->
    step s (State (set1 i n (last s)) (holds s) (add i (Message n (fun j => entry_of (holds s i j))) (sent s)))
| Hears i j m : sent s j m -> step s (State (last s) (set2 i j (hear (last s i) (word_to i m) (holds s i j)) (holds s)) (sent s))
| Forgets i j : step s (State (last s) (set2 i j (fresh (last s i)) (holds s)) (sent s))
| Restarts i n : last s i <= n ->
    step s (State (set1 i n (last s)) (set1 i (fun _ => fresh n) (holds s)) (sent s))
| Lies i m : i \in A -> step s (State (last s) (holds s) (add i m (sent s))).

Definition start := State (fun _ => 0) (fun _ _ => fresh 0) (fun _ _ => False).

Inductive reachable : state -> Prop :=
| Start : reachable start
| Step s s' : reachable s -> step s s' -> reachable s'.

(* What holds of normal robots i and j in every state. *)
Record invariant (s : state) (i j : V) : Prop := Invariant {
  born_sent : born (holds s i j) <= last s i;
  since_born : forall a, since (holds s i j) = Some a -> born (holds s i j) <= a <= last s i;
  numbered : forall m, sent s i m -> number m <= last s i;
  heard_sent : forall w, heard (holds s i j) = Some w -> exists2 m, sent s j m & w = word_to i m;
  (* what j has acknowledged, it has acknowledged in a message that is not newer than the newest *)
  known_said : 0 < known (holds s i j) -> exists2 m, sent s j m &
    known (holds s i j) = acked (says m i) /\
    number m <= (if heard (holds s i j) is Some w then of_number w else 0);
  (* every message after `since` lists j *)
  all_list : forall a m, since (holds s i j) = Some a -> sent s i m -> a < number m -> listed (says m j);
  (* what i acknowledges was sent by j *)
  ack_sent : forall m, sent s i m -> acked (says m j) <= last s j;
  (* in its present life i has heard what it acknowledged *)
  ack_heard : forall m, sent s i m -> born (holds s i j) < number m ->
    acked (says m j) <= (if heard (holds s i j) is Some w then of_number w else 0);
  (* a message of j that knows the present life of i is newer than all that earlier lives of i acknowledged *)
  lives : forall m m', sent s i m -> number m <= born (holds s i j) ->
    sent s j m' -> born (holds s i j) < acked (says m' i) -> acked (says m j) < number m'
}.

Lemma heard_le s i j : invariant s i j -> invariant s j i ->
  (if heard (holds s i j) is Some w then of_number w else 0) <= last s j.
Proof.
move=> I J; case E: (heard _) => [w|//]; have [m mj ->] := heard_sent I E.
exact: (numbered J mj).
Qed.

Lemma set2_same i j h f : set2 i j h f i j = h. Proof. by rewrite /set2 /set1 !eqxx. Qed.
Lemma set2_other i j h f k l : (k, l) != (i, j) -> set2 i j h f k l = f k l.
Proof. by rewrite /set2 /set1 xpair_eqE; case: eqP => [->|] //; case: eqP. Qed.

(* A step at one hold of i about j: what of the invariant depends on that hold alone. *)
Lemma change s k l h i j : (forall i j, i \notin A -> j \notin A -> invariant s i j) ->
  (k \notin A -> l \notin A -> invariant (State (last s) (set2 k l h (holds s)) (sent s)) k l) ->
  i \notin A -> j \notin A -> invariant (State (last s) (set2 k l h (holds s)) (sent s)) i j.
Proof.
move=> old new iA jA; have [[Ei Ej] | ne] := altP ((i, j) =P (k, l)).
  by move: iA jA; rewrite Ei Ej; exact: new.
have [] := old i j iA jA; split; rewrite /= ?set2_other //.
Qed.

Theorem invariant_holds s : reachable s ->
  forall i j, i \notin A -> j \notin A -> invariant s i j.
Proof.
elim=> [|{}s s' _ IH st]; first by move=> i j _ _; split.
case: st => [k l|k l|k n lt|k l m sm|k l|k n le|k m kA].
- move=> i j iA jA; apply: change => // {i j iA jA} kA lA; have I := IH k l kA lA.
  have [bs sb nu hs kn al ak ah li] := I; split; rewrite /= ?set2_same //=.
  + by move=> a; case E: (since _) => [a'|] [<-]; [exact: sb | rewrite bs leqnn].
  + move=> a m; case E: (since _) => [a'|] [<-]; first exact: al.
    by move=> /nu; rewrite leqNgt => /negbTE ->.
- move=> i j iA jA; apply: change => // {i j iA jA} kA lA; have I := IH k l kA lA.
  by have [bs sb nu hs kn al ak ah li] := I; split; rewrite /= ?set2_same.
- move=> i j iA jA; have I := IH i j iA jA; have J := IH j i jA iA.
  have [bs sb nu hs kn al ak ah li] := I.
  have up v : last s v <= set1 k n (last s) v by rewrite /set1; case: eqP => // ->; exact: ltnW.
  split=> /=.
  + exact: leq_trans (up i).
  + by move=> a /sb /andP [-> h]; exact: leq_trans (up i).
  + move=> m [/nu h | [-> ->]]; [exact: leq_trans (up i) | by rewrite /set1 eqxx].
  + by move=> w /hs [m sm ->]; exists m => //; left.
  + by move=> /kn [m sm h]; exists m => //; left.
  + move=> a m E [sm | [Ei ->]] /=; first exact: al E sm.
    by rewrite -Ei /lists E.
  + move=> m [/ak h | [Ei ->]] /=; apply: leq_trans (up j) => //.
    by rewrite -Ei; exact: heard_le.
  + move=> m [sm | [Ei ->]] /=; first exact: ah.
    by rewrite -Ei.
  + move=> m m' [sm | [Ei ->]] /=; last first.
      by move=> le; have := leq_trans lt le; rewrite -Ei ltnNge bs.
    move=> le [sm' | [Ej ->]] /=; first exact: li.
    move=> _; have := ak m sm; rewrite Ej => h; exact: leq_ltn_trans h lt.
- move=> i j iA jA; apply: change => // {i j iA jA} kA lA; have I := IH k l kA lA.
  have [bs sb nu hs kn al ak ah li] := I; rewrite /hear; case: ifP => // nw; split; rewrite /= ?set2_same //=.
  + by move=> w [<-]; exists m.
  + have old : 0 < known (holds s k l) -> exists2 m0, sent s l m0 &
        known (holds s k l) = acked (says m0 k) /\ number m0 <= number m.
      move=> /kn [m0 s0 [E le]]; exists m0; rewrite // E; split=> //; apply: leq_trans le _.
      by move: nw; rewrite /newer; case: (heard _) => // w /ltnW.
    case: ifP => // le; case: (leqP (acked (says m k)) (known (holds s k l))) => big; first exact: old.
    by move=> _; exists m.
  + move=> m' sm' lt; apply: leq_trans (ah m' sm' lt) _; move: nw; rewrite /newer.
    by case: (heard _) => // w /ltnW.
- move=> i j iA jA; apply: change => // {i j iA jA} kA lA; have I := IH k l kA lA.
  have J := IH l k lA kA; have [bs sb nu hs kn al ak ah li] := I.
  split; rewrite /= ?set2_same //=.
  + by move=> m /nu; rewrite leqNgt => /negbTE ->.
  + by move=> m m' _ _ /(ack_sent J); rewrite leqNgt => /negbTE ->.
- move=> i j iA jA; have I := IH i j iA jA; have J := IH j i jA iA.
  have [bs sb nu hs kn al ak ah li] := I.
  have up v : last s v <= set1 k n (last s) v by rewrite /set1; case: eqP => // ->.
  have [Ek | ne] := altP (i =P k); last first.
    have E : set1 k (fun=> fresh n) (holds s) i j = holds s i j by rewrite /set1 (negbTE ne).
    split; rewrite /= ?E //.
    + exact: leq_trans (up i).
    + by move=> a /sb /andP [-> h]; exact: leq_trans (up i).
    + by move=> m /nu h; exact: leq_trans (up i).
    + by move=> m /ak h; exact: leq_trans (up j).
  have E : set1 k (fun=> fresh n) (holds s) i j = fresh n by rewrite /set1 Ek eqxx.
  split; rewrite /= ?E //=.
  + by rewrite /set1 Ek eqxx.
  + by move=> m /nu h; exact: leq_trans (up i).
  + by move=> m /ak h; exact: leq_trans (up j).
  + move=> m /nu h lt; have := leq_trans h (up i); rewrite /set1 Ek eqxx leqNgt lt //.
  + move=> m m' _ _ /(ack_sent J); rewrite Ek => h lt.
    by have := leq_trans lt (leq_trans h le); rewrite ltnn.
- move=> i j iA jA; have I := IH i j iA jA; have [bs sb nu hs kn al ak ah li] := I.
  have ik : i <> k by move=> E; move: iA; rewrite E kA.
  have jk : j <> k by move=> E; move: jA; rewrite E kA.
  split=> //=.
  + by move=> m' [/nu | []].
  + by move=> w /hs [m' sm ->]; exists m' => //; left.
  + by move=> /kn [m' sm h]; exists m' => //; left.
  + by move=> a m' E [/(al a m' E) | []].
  + by move=> m' [/ak | []].
  + by move=> m' [/ah | []].
  + by move=> m1 m2 [s1 | []] // le [s2 | []] //; exact: li.
Qed.

(* Of lem:counted what j needs to know: it has acknowledged a message of i, from which on all messages of i list it. *)
Lemma row_while_listed s i j a m : reachable s -> i \notin A -> j \notin A ->
  (forall m', sent s i m' -> a < number m' -> listed (says m' j)) ->
  sent s j m -> a < acked (says m i) -> active (holds s j i).
Proof.
move=> re iA jA all mj ak; have J := invariant_holds re jA iA.
apply/orP; right; apply/negP => /andP [knows]; case Eh: (heard _) => [w|//] nl.
(* m' is the newest message of i that j has; m'' showed j that i knows its life. *)
have [m' mi Ew] := heard_sent J Eh.
have [m'' mi' [Em'' older]] := known_said J (leq_ltn_trans (leq0n _) knows).
rewrite Eh Ew /= in older; rewrite Ew /= in nl; rewrite Em'' in knows.
have old : number m' <= a by rewrite leqNgt; apply/negP => lt; move: nl; rewrite (all _ mi lt).
have [earlier | present] := leqP (number m) (born (holds s j i)).
  have lt := lives J mj earlier mi' knows.
  by have := leq_trans (leq_trans lt older) old; rewrite leqNgt ltnS (ltnW ak).
have := ack_heard J mj present; rewrite Eh Ew /= leqNgt => /negP; apply.
exact: leq_ltn_trans old ak.
Qed.

(* lem:counted *)
Theorem counted_is_held s i j : reachable s -> i \notin A -> j \notin A ->
  counts (holds s i j) -> active (holds s i j) /\ active (holds s j i).
Proof.
move=> re iA jA; have I := invariant_holds re iA jA.
rewrite /counts; case Es: (since _) => [a|//] ak; split; first by rewrite /active /lists Es.
have [m mj [Em _]] := known_said I (leq_ltn_trans (leq0n _) ak).
apply: (@row_while_listed s i j a m) => //; last by rewrite -Em.
by move=> m' mi lt; exact: (all_list I Es mi lt).
Qed.

(* Steps in which i sends no message that does not list j, whatever else happens: i may begin anew, and j too. *)
Inductive lists_on (i j : V) (s : state) : state -> Prop :=
| Nothing : lists_on i j s s
| Another s' s'' : lists_on i j s s' -> step s' s'' ->
    (forall m, sent s'' i m -> sent s' i m \/ listed (says m j)) -> lists_on i j s s''.

Lemma sent_stays s s' i m : step s s' -> sent s i m -> sent s' i m.
Proof. by case=> //= *; left. Qed.

(* thm:anew, the row of j: i counted on j, forgets everything, and lists j from its first message on. *)
Theorem anew s s' i j : reachable s -> i \notin A -> j \notin A ->
  counts (holds s i j) -> lists_on i j s s' -> active (holds s' j i).
Proof.
move=> re iA jA; have I := invariant_holds re iA jA.
rewrite /counts; case Es: (since _) => [a|//] ak on.
have [m mj [Em _]] := known_said I (leq_ltn_trans (leq0n _) ak).
suff [re' [all mj']] : reachable s' /\
    (forall m', sent s' i m' -> a < number m' -> listed (says m' j)) /\ sent s' j m.
  by apply: (@row_while_listed s' i j a m) => //; rewrite -Em.
elim: on => [|{}s' s'' _ [re' [all mj']] st new].
  by split=> //; split=> // m' mi lt; exact: (all_list I Es mi lt).
split; first exact: Step re' st.
by split=> [m' /new [mi lt | li _] //|]; [exact: all mi lt | exact: sent_stays st mj'].
Qed.
End Protocol.
