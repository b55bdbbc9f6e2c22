# Sourced by run.sh and python.sh: certificates and the files of Zenoh for a router, two robots, a plant and a stranger, in $work.
# An authority, and a certificate for each process: authority NAME, certificate NAME AUTHORITY.
authority() {
  openssl req -x509 -newkey ed25519 -nodes -keyout "$1.key" -out "$1.pem" -days 30 -subj "/CN=$1" 2> /dev/null
}
certificate() {
  printf 'subjectAltName = DNS:localhost\nextendedKeyUsage = serverAuth, clientAuth\n' > "$1.ext"
  openssl req -newkey ed25519 -nodes -keyout "$1.tls" -out "$1.csr" -subj "/CN=$1" 2> /dev/null
  openssl x509 -req -in "$1.csr" -CA "$2.pem" -CAkey "$2.key" -CAcreateserial -days 30 -extfile "$1.ext" -out "$1.pem" 2> /dev/null
  chmod 600 "$1.tls"
}
authority ours
authority theirs
for name in router robot_1 robot_2 plant; do certificate "$name" ours; done
certificate stranger theirs

# What Zenoh is told: certificates for both directions of a connection, each end showing its own.
tls() {
  cat << T
transport: { link: { tls: {
  root_ca_certificate: "$work/ours.pem", enable_mtls: true, verify_name_on_connect: true,
  listen_private_key: "$work/$1.tls", listen_certificate: "$work/$1.pem",
  connect_private_key: "$work/$1.tls", connect_certificate: "$work/$1.pem",
} } },
T
}
for name in robot_1 robot_2 plant stranger; do { echo "{"; tls "$name"; echo "}"; } > "$name.json5"; done

# Whoever has a certificate of ours may listen; a robot may put what is its own, and the plant what robots are shown.
rule() { printf '{ id: "%s", messages: ["put"], flows: ["ingress"], permission: "allow", key_exprs: [%s] },\n' "$1" "$2"; }
own() { printf '"closeranks/say/%s", "closeranks/report/%s", "closeranks/status/%s", "closeranks/evidence/*", "closeranks/proof/*", "closeranks/doctor/%s"' "$1" "$1" "$1" "$1"; }
{
  echo "{"
  tls router
  echo 'access_control: { enabled: true, default_permission: "deny", rules: ['
  rule robot_1 "$(own 1)"
  rule robot_2 "$(own 2)"
  rule plant '"closeranks/sensed/*"'
  echo '{ id: "out", messages: ["put"], flows: ["egress"], permission: "allow", key_exprs: ["closeranks/**"] },'
  echo '{ id: "listen", messages: ["declare_subscriber"], flows: ["ingress", "egress"], permission: "allow", key_exprs: ["closeranks/**"] },'
  echo '], subjects: ['
  for name in robot_1 robot_2 plant; do echo "{ id: \"$name\", cert_common_names: [\"$name\"] },"; done
  echo '], policies: ['
  for name in robot_1 robot_2 plant; do echo "{ rules: [\"$name\", \"out\", \"listen\"], subjects: [\"$name\"] },"; done
  echo '] } }'
} > router.json5
