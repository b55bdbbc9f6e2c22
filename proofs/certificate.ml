(* Reads certificates of `closeranks check --certificate` and asks the extracted checkers of evidence.v and roles.v.

     certificate FILE            says what is proved, or that nothing is; exit code 0 or 1
     certificate --stream FILE   many certificates, each followed by a line `verdict yes` or `verdict no` of another checker: says
                                 how many there are, or which one the two judge differently

   The reader is not proved. It takes no more than crates/graph/src/evidence/text.rs does. *)

exception Refused

let numbers text =
  let number word =
    if word <> "" && String.for_all (fun c -> '0' <= c && c <= '9') word && String.length word < 10
    then int_of_string word else raise Refused in
  List.map number (List.filter (fun word -> word <> "") (String.split_on_char ' ' text))

(* The numbers of a line that begins with a word. *)
let after word line =
  let length = String.length word in
  if line = word then []
  else if String.length line > length && String.sub line 0 (length + 1) = word ^ " "
  then numbers (String.sub line length (String.length line - length))
  else raise Refused

let rec rising = function a :: (b :: _ as rest) -> a < b && rising rest | _ -> true

let rec network node count lines =
  if node = count then [], lines
  else match lines with
    | line :: rest ->
      (match after "hears" line with
       | own :: heard when own = node && rising heard ->
         let others, rest = network (node + 1) count rest in heard :: others, rest
       | _ -> raise Refused)
    | [] -> raise Refused

(* A domain from a sum of roles: honest in S1 1, honest in S2 2, neither 4, a liar with S1 8, a liar with S2 16. *)
let domain sum =
  if sum < 1 || sum > 31 then raise Refused;
  let bit k = sum land k <> 0 in
  { Evidence_checker.h1 = bit 1; h2 = bit 2; ne = bit 4; l1 = bit 8; l2 = bit 16 }

let rec choices = function
  | [] -> []
  | node :: sum :: rest -> (node, domain sum) :: choices rest
  | [_] -> raise Refused

(* `roots N`, then N lines `root ..`, and nothing else; at most as many as there are nodes. *)
let roots count lines =
  match lines with
  | first :: lines ->
    (match after "roots" first with
     | [number] when number <= count && number = List.length lines ->
       let root line = match after "root" line with
         | node :: rest -> node, choices rest
         | [] -> raise Refused in
       List.map root lines
     | _ -> raise Refused)
  | [] -> raise Refused

(* Whole numbers as Coq has them. *)
let rec positive n =
  if n = 1 then Evidence_checker.XH
  else if n land 1 = 1 then Evidence_checker.XI (positive (n lsr 1)) else Evidence_checker.XO (positive (n lsr 1))
let whole n =
  if n = 0 then Evidence_checker.Z0 else if n > 0 then Evidence_checker.Zpos (positive n) else Evidence_checker.Zneg (positive (-n))

let signed word =
  let digits = if word <> "" && word.[0] = '-' then String.sub word 1 (String.length word - 1) else word in
  if digits <> "" && String.length digits <= 13 && String.for_all (fun c -> '0' <= c && c <= '9') digits
  then whole (int_of_string word) else raise Refused

(* `low Q` or `high Q`, then a line `row ..` for each node. *)
let triangle word count lines =
  let row line =
    match String.split_on_char ' ' line with
    | "row" :: words -> List.map signed (List.filter (fun word -> word <> "") words)
    | _ -> raise Refused in
  let rec rows number lines =
    if number = 0 then [], lines
    else match lines with
      | line :: rest -> let row = row line in let others, rest = rows (number - 1) rest in row :: others, rest
      | [] -> raise Refused in
  match lines with
  | first :: rest ->
    (match after word first with
     | [bound] -> let rows, rest = rows count rest in whole bound, rows, rest
     | _ -> raise Refused)
  | [] -> raise Refused

let judge lines =
  let lines = List.filter (fun line -> line = "" || line.[0] <> '#') lines in
  match lines with
  | "closeranks certificate 1" :: nodes :: rest ->
    let count = match after "nodes" nodes with [count] when count > 0 -> count | _ -> raise Refused in
    let network, rest = network 0 count rest in
    let starts word = match rest with line :: _ -> List.hd (String.split_on_char ' ' line) = word | [] -> false in
    (match rest with
     | [claim; first; second] when starts "not-robust" ->
       (match after "not-robust" claim with
        | [r; s] ->
          Evidence_checker.refutes_check network r s (after "set" first) (after "set" second),
          Printf.sprintf "not (%d,%d)-robust" r s
        | _ -> raise Refused)
     | [claim] when starts "robust-by-degrees" ->
       (match after "robust-by-degrees" claim with
        | [r] -> Evidence_checker.degrees_check network r, Printf.sprintf "(%d,s)-robust for every s" r
        | _ -> raise Refused)
     | [claim; core; others] when starts "ranks" ->
       (match after "ranks" claim with
        | [f] ->
          Evidence_checker.order_check network f (after "core" core) (after "rest" others),
          Printf.sprintf "survives any %d liars around each node" f
        | _ -> raise Refused)
     | claim :: proof when starts "robust-by-search" ->
       (match after "robust-by-search" claim with
        | [r; s] ->
          Evidence_checker.search_check network r s (roots count proof),
          Printf.sprintf "(%d,%d)-robust" r s
        | _ -> raise Refused)
     | claim :: proof when starts "robust-by-eigenvalues" ->
       (match after "robust-by-eigenvalues" claim with
        | [r; s] when s <= count ->
          let low, low_rows, proof = triangle "low" count proof in
          let high, high_rows, proof = triangle "high" count proof in
          if proof <> [] || s = 0 then raise Refused;
          let unit_, ones, scale = whole 65536, whole 131072, whole 16777216 in
          Evidence_checker.eigen_check network r s unit_ low high ones scale low_rows high_rows,
          Printf.sprintf "(%d,%d)-robust" r s
        | _ -> raise Refused)
     | claim :: core :: others :: proof when starts "ranks-by-search" ->
       (match after "ranks-by-search" claim with
        | [f] ->
          Evidence_checker.searched_order_check network f (after "core" core) (after "rest" others) (roots count proof),
          Printf.sprintf "survives any %d liars around each node" f
        | _ -> raise Refused)
     | _ -> raise Refused)
  | _ -> raise Refused

let judge lines = try judge lines with Refused -> false, "no certificate"

let lines_of file =
  let channel = open_in file in
  let rec read lines = match input_line channel with
    | line -> read (line :: lines)
    | exception End_of_file -> close_in channel; List.rev lines in
  read []

let stream lines =
  let count = ref 0 and accepted = ref 0 in
  let compare block verdict =
    let own, _ = judge (List.rev block) in
    incr count;
    if own then incr accepted;
    if own <> verdict then begin
      Printf.printf "judged differently, here %b:\n%s\n" own (String.concat "\n" (List.rev block));
      exit 1
    end in
  let last = List.fold_left (fun block line -> match line with
    | "verdict yes" -> compare block true; []
    | "verdict no" -> compare block false; []
    | line -> line :: block) [] lines in
  if last <> [] || !accepted = 0 || !accepted = !count then (print_endline "not a stream of verdicts of both kinds"; exit 1);
  Printf.printf "%d certificates, %d of them accepted, judged alike by both checkers\n" !count !accepted

let () =
  match Array.to_list Sys.argv with
  | [_; "--stream"; file] -> stream (lines_of file)
  | [_; file] ->
    let proved, claim = judge (lines_of file) in
    if proved then print_endline ("proved: " ^ claim) else (print_endline ("nothing is proved: " ^ claim); exit 1)
  | _ -> prerr_endline "use: certificate FILE, or certificate --stream FILE"; exit 2
