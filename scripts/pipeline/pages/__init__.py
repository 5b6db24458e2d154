"""Figures' style, texts and tables of the report and of the pages of surfaces."""
