"""Makes what the programs of a secured run prove themselves by: certificates of a CA of its own, and what each may do.

    ./run.sh --make-identities FOLDER [--encrypt] [--days N]

Formats: OMG DDS Security 1.1, 9.4 (governance and permissions, signed by the CA as S/MIME), of which Cyclone DDS has the
plugins. The names of the topics are those of common/link/wire.hpp."""

import argparse
import contextlib
import datetime
import os
import pathlib
import secrets
import shutil
import subprocess
import sys
import tempfile

from toryu import counted, program
from toryu.installation import COMMAND, INSTALLER
from toryu.processes import BAD_INPUT, DONE, MACHINE

TO_COUPLER = {"fluid": ("hello_from_fluid", "status_from_fluid", "load_from_fluid", "checkpoint_from_fluid"),
              "solid": ("hello_from_solid", "status_from_solid", "interface_from_solid", "motion_from_solid",
                        "checkpoint_from_solid")}
FROM_COUPLER = {"fluid": ("session", "checkpoint_request", "interface_to_fluid", "motion_to_fluid"),
                "solid": ("session", "checkpoint_request", "load_to_solid")}
DAYS, MOST_DAYS = 365, 36500
NEW_KEY = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-sha256")

# Each packet is authenticated, which costs less than each of its parts; what is encrypted besides is the content of messages.
# What is of participants is alike with and without: Cyclone DDS passes over those of another kind in silence, so that they
# could not be named.
GOVERNANCE = """<?xml version="1.0" encoding="utf-8"?>
<dds><domain_access_rules><domain_rule>
  <domains><id_range><min>0</min><max>230</max></id_range></domains>
  <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
  <enable_join_access_control>true</enable_join_access_control>
  <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
  <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
  <rtps_protection_kind>SIGN</rtps_protection_kind>
  <topic_access_rules><topic_rule>
    <topic_expression>*</topic_expression>
    <enable_discovery_protection>true</enable_discovery_protection>
    <enable_liveliness_protection>true</enable_liveliness_protection>
    <enable_read_access_control>true</enable_read_access_control>
    <enable_write_access_control>true</enable_write_access_control>
    <metadata_protection_kind>NONE</metadata_protection_kind>
    <data_protection_kind>{data}</data_protection_kind>
  </topic_rule></topic_access_rules>
</domain_rule></domain_access_rules></dds>
"""
PERMISSIONS = """<?xml version="1.0" encoding="utf-8"?>
<dds><permissions><grant name="{part}">
  <subject_name>CN={part}</subject_name>
  <validity><not_before>{begin}</not_before><not_after>{end}</not_after></validity>
  <allow_rule>
    <domains><id_range><min>0</min><max>230</max></id_range></domains>
    <publish>{publish}</publish>
    <subscribe>{subscribe}</subscribe>
  </allow_rule>
  <default>DENY</default>
</grant></permissions></dds>
"""


def topics_of(part):
    """What the part may write, and what it may read."""
    if part in TO_COUPLER:
        return TO_COUPLER[part], FROM_COUPLER[part]
    return tuple({name: None for names in FROM_COUPLER.values() for name in names}), sum(TO_COUPLER.values(), ())


def permissions(part, now, days):
    publish, subscribe = ("<topics>" + "".join(f"<topic>toryu/{name}</topic>" for name in names) + "</topics>"
                          for names in topics_of(part))
    return PERMISSIONS.format(part=part, publish=publish, subscribe=subscribe,
                              begin=(now - datetime.timedelta(days=1)).isoformat() + "Z",
                              end=(now + datetime.timedelta(days=days)).isoformat() + "Z")


def refuse(text, code=BAD_INPUT):
    print(text, file=sys.stderr)
    raise SystemExit(code)


def openssl(*words, text=None, key=None):
    """Runs openssl, which finds the open file `key` under the name that `named` gives it."""
    try:
        done = subprocess.run(["openssl", *map(str, words)], input=text, capture_output=True, encoding="utf-8",
                              env=os.environ | {"OPENSSL_CONF": "/dev/null"}, pass_fds=() if key is None else (key,))
    except FileNotFoundError:
        refuse(f"error: the machine: there is no program openssl; '{INSTALLER} run' installs it", MACHINE)
    if done.returncode:
        refuse(f"error: the machine: 'openssl {words[0]}' failed: {done.stderr.strip()}", MACHINE)


def named(key):
    return f"/proc/self/fd/{key}"


@contextlib.contextmanager
def filled_at_once(folder):
    """A new folder beside `folder`, which becomes that when it is filled, and is gone if it cannot be."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    made = pathlib.Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=folder.parent))
    try:
        yield made
        made.rename(folder)
    finally:
        shutil.rmtree(made, ignore_errors=True)


def make(folder, encrypt=False, days=DAYS):
    """Makes the new folder. The key of the CA is in memory alone and ends with this program: nobody can make another
    identity of the run."""
    os.umask(0o077)
    key = os.memfd_create("ca.key")
    now = datetime.datetime.now(datetime.timezone.utc).replace(microsecond=0, tzinfo=None)  # all expire at once
    with filled_at_once(folder) as made:
        authority = made / "ca.pem"

        def sign(text, name):
            openssl("smime", "-sign", "-text", "-signer", authority, "-inkey", named(key), "-out", made / name, text=text, key=key)

        openssl("req", "-x509", *NEW_KEY, "-keyout", named(key), "-out", authority, "-days", days,
                "-subj", f"/CN=toryu {secrets.token_hex(4)}", key=key)
        sign(GOVERNANCE.format(data="ENCRYPT" if encrypt else "NONE"), "governance.p7s")
        for part in ("coupler", "fluid", "solid"):
            request = made / "request"
            openssl("req", *NEW_KEY, "-keyout", made / f"{part}.key", "-out", request, "-subj", f"/CN={part}")
            openssl("x509", "-req", "-in", request, "-CA", authority, "-CAkey", named(key), "-sha256", "-days", days, "-set_serial",
                    int.from_bytes(secrets.token_bytes(8), "big"), "-out", made / f"{part}.pem", key=key)
            sign(permissions(part, now, days), f"{part}.p7s")
            request.unlink()
    os.close(key)


def parse(arguments):
    parser = argparse.ArgumentParser(prog=COMMAND.removeprefix("./"), allow_abbrev=False, description="Makes identities for "
                                     "secured runs: --secure FOLDER, and coupler/README.md, \"Secured\".")
    parser.add_argument("--make-identities", metavar="FOLDER", type=pathlib.Path, required=True, help="a new folder")
    parser.add_argument("--encrypt", action="store_true", help="what is sent is encrypted, and not authenticated alone")
    parser.add_argument("--days", type=int, default=DAYS, help=f"how long they are valid; default {DAYS}")
    return parser.parse_args(arguments)


def main(arguments):
    options = parse(arguments)
    folder = options.make_identities
    if not 0 < options.days <= MOST_DAYS:
        refuse(f"--days {options.days}: error: must be from 1 to {MOST_DAYS}")
    if folder.exists():
        refuse(f"--make-identities {folder}: error: is there already; remove it first, or give another folder")
    try:
        make(folder, options.encrypt, options.days)
    except OSError as error:
        if error.errno in program.SHORTAGES:
            raise
        refuse(f"--make-identities {folder}: error: cannot be written: {error.strerror}")
    print(f"{folder}: identities of coupler, fluid and solid, valid for {counted(options.days, 'day')}; messages will be "
          f"{'encrypted' if options.encrypt else 'authenticated'}. A run takes them by --secure {folder}. Each host needs "
          "ca.pem, governance.p7s and the three files of each part that runs there.")
    return DONE


if __name__ == "__main__":
    program.run(main)
