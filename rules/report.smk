# Claims ledger and report. Filled in below the figures because both read everything.
