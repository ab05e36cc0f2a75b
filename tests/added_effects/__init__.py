"""Every effect of the catalogue hidden in a machine: named, added by the line that is printed, and
compared on a third log: does the error reach that of the machine without it?"""
