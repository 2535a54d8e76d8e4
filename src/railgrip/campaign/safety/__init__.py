"""K_dry_rst, K_wet_rst and what ETCS makes of them: `railgrip campaign safety`.

`case` is the file, `marginals` its distributions, `draws` turns normal numbers into a train,
`formula` and `plant` stop it, `factors` makes the tables, `page` the report.
"""
