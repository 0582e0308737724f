//! Chooses ε for a field with noise, and compares it with the best one, which a known field tells.
use morse_smooth::{Watch, load::*, smooth::*};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = load(&std::fs::read("www/public/examples/torus_irregular.ply")?, &LoadOptions::default())?;
    let field = |wanted: &str| file.fields.iter().find(|(name, _)| name == wanted).map(|(_, values)| values);
    let (clean, noisy) = field("clean").zip(field("noisy")).ok_or("no such field")?;

    let watch = Watch::none();
    let mut smoother = Smoother::new(&file.mesh, SmootherOptions::default())?;
    let family = smoother.family(noisy, &FamilyOptions::default(), &watch)?; // every ε from 1e-6 to 1e4
    let error_of = |epsilon: f64| -> Result<f64, Box<dyn std::error::Error>> {
        Ok(family.values(epsilon)?.iter().zip(clean).map(|(x, f)| (x - f).powi(2)).sum::<f64>().sqrt())
    };
    let chosen = family.choose(EpsilonRule::Gcv, &watch)?;
    let curve = family.sweep(&SweepOptions { counts: true, ..Default::default() }, &watch)?;
    for &epsilon in &curve.epsilons {
        assert!(error_of(chosen.epsilon)? < 1.05 * error_of(epsilon)?, "{}", chosen.reason);
    }
    // The larger ε is, the more of the noise is there.
    let (few, many) = (curve.maxima.first(), curve.maxima.last());
    assert!(few == Some(&1) && many > Some(&500));

    // A torus has a minimum and a maximum whatever the ε; those of the noise come last.
    let lives = family.lives(0, 8, &watch)?;
    let kinds: Vec<bool> = lives.iter().take_while(|life| life.least < 1e-5).map(|life| life.is_maximum).collect();
    assert_eq!((kinds.len(), kinds.iter().filter(|is_maximum| **is_maximum).count()), (2, 1));
    Ok(())
}
