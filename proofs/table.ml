(* Writes cases with the answers of the extracted model, a line each:
     F own | told ... | below above kept sum least greatest
   `table small` writes every case with values -2 to 2 and up to four told ones, and 500 drawn ones; `table large COUNT` draws COUNT. *)

let line faults own told =
  let (((below, above), kept), sum) = Model.answer faults own told in
  let least = List.fold_left min own kept and greatest = List.fold_left max own kept in
  Printf.printf "%d %d |%s | %d %d %d %d %d %d\n" faults own
    (String.concat "" (List.map (Printf.sprintf " %d") told))
    below above (List.length kept) sum least greatest

(* A generator of our own, so that every version of OCaml draws the same. *)
let state = ref 1
let draw below =
  state := (!state * 1103515245 + 12345) land 0x3fffffff;
  (!state lsr 8) mod below

let drawn () =
  let count = draw 25 and width = 1 + draw 40 in
  let value () = draw (2 * width + 1) - width in
  let own = value () in
  let told = List.init count (fun _ -> value ()) in
  line (draw 8) own told

let rec lists length =
  if length = 0 then [[]]
  else List.concat_map (fun rest -> List.map (fun v -> v :: rest) [-2; -1; 0; 1; 2]) (lists (length - 1))

let every () =
  List.iter (fun length ->
    List.iter (fun told -> List.iter (fun faults -> line faults 0 told) [0; 1; 2]) (lists length))
    [0; 1; 2; 3; 4]

let () =
  match Array.to_list Sys.argv with
  | [_; "small"] -> every (); for _ = 1 to 500 do drawn () done
  | [_; "large"; count] -> for _ = 1 to int_of_string count do drawn () done
  | _ -> prerr_endline "use: table small, or table large COUNT"; exit 2
