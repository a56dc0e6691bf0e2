"""The other commands as functions: what they leave is opened."""

import json

import numpy as np
import pytest

import weaveform as wf


def test_stages_one_by_one_give_what_run_gives(bias, examples, tmp_path):
    from conftest import small

    meshed = wf.mesh(examples / "bias_extension_pw.toml", small, output=tmp_path / "staged", progress=False)
    solved = wf.solve(meshed, progress=False, threads=1)
    posted = wf.post(solved.path, progress=False)
    for name, values in bias.history.items():
        assert np.array_equal(posted.history[name], values), name
    assert posted.summary["measures"] == bias.summary["measures"]


def test_a_fit_gives_a_card_that_a_scene_takes(examples, tmp_path):
    fit = wf.fit(examples / "fit" / "twintex.toml", output=tmp_path / "fit", progress=False)
    assert fit.card.is_file() and fit.report == json.loads((tmp_path / "fit" / "report.json").read_text())
    text = wf.check(examples / "bias_extension_pw.toml", {"fabric.material": fit.card})
    assert str(fit.card) in text
    assert "shear stress" in fit.answer.text


def test_a_study_has_its_cases_and_their_results(tmp_path, examples):
    (tmp_path / "study.toml").write_text(f"""
scene = "{examples / 'bias_extension_pw.toml'}"
measures = ["grips.top.force_N"]
[set]
"grip.top.travel" = 5.0
"analysis.duration" = 0.05
"output.frames" = 1
[grid]
"blank.coarsening" = [5, 4]
""")
    study = wf.study(tmp_path / "study.toml", output=tmp_path / "study", progress=False, jobs=2)
    assert study.cases["blank.coarsening"].tolist() == [5, 4] and study.cases["exit_code"].tolist() == [0, 0]
    for row in range(2):
        result = study.result(row)
        assert result.summary["grips"]["top"]["force_N"] == pytest.approx(study.cases["grips.top.force_N"][row])


def test_exports_are_written_where_they_are_asked_for(bias, examples, tmp_path):
    file = wf.export(bias, tmp_path / "fibres.csv", "csv")
    table = wf.Table(file)
    assert table.rows >= len(bias.mesh.cells.nodes)
    deck = wf.export(examples / "bias_extension_pw.toml", tmp_path / "deck.inp", "abaqus", {"blank.coarsening": 4})
    assert "*ELEMENT" in deck.read_text()
    with pytest.raises(wf.InputError):
        wf.export(bias, tmp_path / "x", "nastran")


def test_a_report_is_written_where_it_is_asked_for(bias, tmp_path):
    page = wf.report(bias, tmp_path / "page.html")
    assert page == tmp_path / "page.html" and page.read_text().startswith("<!DOCTYPE html>")
    with pytest.raises(wf.FileError):
        wf.report(tmp_path / "nowhere")


def test_a_virtual_measurement_compares_with_its_own_simulation(bias, tmp_path):
    virtual = wf.virtual(bias, {"instrument.facet_size": 10}, output=tmp_path / "virtual", progress=False)
    assert virtual.table("loads.csv").units == {"displacement_mm": "mm", "force_N": "N"}
    comparison = wf.compare(bias, virtual.path / "stages", settings=virtual.path / "settings.toml",
                            output=tmp_path / "comparison", progress=False)
    assert comparison.stages.rows == len(bias.frames) - 1 and comparison.summary
    assert np.abs(comparison.stages["all.difference_rms_deg"]).max() < 1e-6
