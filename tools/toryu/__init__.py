"""Runs cases and studies of toryu, and reads what they leave."""

from toryu.installation import folder_of_programs

PROGRAMS = folder_of_programs()


def counted(count, thing):
    """"1 run", "2 runs": `thing` takes an s unless there is one."""
    return f"{count} {thing}{'' if count == 1 else 's'}"
