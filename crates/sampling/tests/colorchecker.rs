//! The ColorChecker study: every product of one to four of its 24 reflectances, under five lamps.

use illuminant_sampling::{Basis, Comparison, Fitted, Products, SpectralError, compare};
use illuminant_spectrum::{Curve, Outside, SpectralRange};

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../python/illuminant/data/");
const LAMPS: [&str; 5] = ["c", "d65", "a", "fl2", "fl11"];
/// Products that a fit may look at.
const FITTED_ON: usize = 2000;

/// The columns of a table of the library.
fn columns(file: &str, outside: Outside) -> Vec<Curve> {
    read(&format!("{DATA}{file}"), outside)
}

fn read(path: &str, outside: Outside) -> Vec<Curve> {
    let text = std::fs::read_to_string(path).unwrap();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        .map(|line| line.split(',').map(|field| field.parse().unwrap()).collect())
        .collect();
    let wavelengths: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    (1..rows[0].len())
        .map(|c| Curve::new(wavelengths.clone(), rows.iter().map(|row| row[c]).collect(), outside).unwrap())
        .collect()
}

fn lamp(name: &str) -> Curve {
    columns(&format!("illuminants/{name}.csv"), Outside::Zero).remove(0)
}

fn checker() -> Vec<Curve> {
    columns("colorchecker/babelcolor_average.csv", Outside::Hold)
}

fn products(lamps: &[Curve], most: usize) -> Products {
    products_of(&checker(), lamps, most, 1)
}

fn products_of(reflectances: &[Curve], lamps: &[Curve], most: usize, seed: u64) -> Products {
    let mut products = Products::new(SpectralRange::default(), lamps.to_vec()).unwrap();
    products.add_reflectances(reflectances, 4, most, seed);
    products
}

/// Mean and maximum as exposed, and with every product lit to half the white.
fn judge(basis: &dyn Basis, all: &Products) -> (SpectralError, SpectralError) {
    let found = compare(basis, all);
    let lit: Vec<_> = found.iter().cloned().map(Comparison::lit_to_half).collect();
    (SpectralError::over(&found), SpectralError::over(&lit))
}

#[test]
fn fitted_sampling_reaches_its_figures_under_each_lamp() {
    let range = SpectralRange::default();
    // Mean and maximum, as exposed and lit to half.
    let limits = [(8, 0.1, 1.5, 0.45, 6.0), (12, 0.03, 0.6, 0.12, 2.0), (16, 0.015, 0.4, 0.05, 1.0)];
    for name in LAMPS {
        let lamps = [lamp(name)];
        let (some, all) = (products(&lamps, FITTED_ON), products(&lamps, usize::MAX));
        assert_eq!((some.items.len(), all.items.len()), (FITTED_ON, 20_474));
        for (n, mean, max, lit_mean, lit_max) in limits {
            let basis = Fitted::new(n, range, &some).unwrap();
            let (exposed, lit) = judge(&basis, &all);
            assert!(exposed.mean <= mean && exposed.max <= max, "{name} fitted:{n} {exposed:?}");
            assert!(lit.mean <= lit_mean && lit.max <= lit_max, "{name} fitted:{n} lit to half {lit:?}");
        }
    }
}

#[test]
fn five_lamps_in_one_scene_are_served_by_the_same_wavelengths() {
    let lamps = LAMPS.map(lamp);
    let some = products(&lamps, FITTED_ON);
    let all = products(&lamps, usize::MAX);
    for (n, mean, max) in [(8, 0.15, 2.0), (12, 0.05, 1.3), (16, 0.02, 0.4)] {
        let basis = Fitted::new(n, SpectralRange::default(), &some).unwrap();
        let (exposed, _) = judge(&basis, &all);
        assert!(exposed.mean <= mean && exposed.max <= max, "fitted:{n} {exposed:?}");
    }
}

#[test]
fn materials_that_the_fit_has_not_seen_are_served_too() {
    let text = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/cie_2017_samples.csv");
    let unknown = read(text, Outside::Hold);
    assert_eq!(unknown.len(), 99);
    let range = SpectralRange::default();
    for name in LAMPS {
        let lamps = [lamp(name)];
        let some = products(&lamps, FITTED_ON);
        let others = products_of(&unknown, &lamps, 10_000, 2);
        for (n, mean, max) in [(8, 0.3, 3.0), (12, 0.11, 1.0)] {
            let basis = Fitted::new(n, range, &some).unwrap();
            let (exposed, _) = judge(&basis, &others);
            assert!(exposed.mean <= mean && exposed.max <= max, "{name} fitted:{n} {exposed:?}");
        }
    }
}

#[test]
fn a_lamp_so_red_that_it_has_no_z_is_a_lamp() {
    let red = Curve::new(vec![655.0, 667.0, 680.0], vec![0.0, 1.0, 0.0], Outside::Zero).unwrap();
    for lamps in [vec![red.clone()], vec![red.clone(), lamp("d65")]] {
        for one_map in [false, true] {
            let mut some = products(&lamps, 500);
            some.one_map = one_map;
            let basis = Fitted::new(8, SpectralRange::default(), &some).unwrap();
            let (exposed, _) = judge(&basis, &some);
            assert!(exposed.mean < 0.3 && exposed.max < 3.0, "{} lamps, {one_map}: {exposed:?}", lamps.len());
        }
        let boxes =
            illuminant_sampling::Hall::local_search(9, SpectralRange::default(), &products(&lamps, 100));
        assert_eq!(boxes.len(), 9);
    }
}

#[test]
fn wavelengths_serve_lamps_that_come_later_and_weights_the_lamps_that_are_here() {
    let (day, lines) = (lamp("d65"), lamp("fl11"));
    let mut both = products(&[day.clone(), lines], 400);
    both.one_map = true;
    both.together = 1;
    let alone = products(&[day], 400);
    let with = Fitted::new(8, SpectralRange::default(), &both).unwrap();
    let mut shared = alone.clone();
    shared.one_map = true;
    let without = Fitted::new(8, SpectralRange::default(), &shared).unwrap();
    let wavelengths = |basis: &Fitted| (0..8).map(|i| basis.wavelength_nm(i)).collect::<Vec<_>>();
    assert_ne!(wavelengths(&with), wavelengths(&without));
    // Under its own lamp it is nearly as good as one that knows of no other.
    let error = |basis: &Fitted| SpectralError::over(&compare(basis, &alone));
    let (with, without) = (error(&with), error(&without));
    assert!(with.mean < 0.3 && with.max < 3.0, "{with:?} beside {without:?}");
}
