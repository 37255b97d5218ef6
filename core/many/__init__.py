"""Contacts of more waves than are walked one by one."""
